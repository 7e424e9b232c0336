#include "ros/threads/background_thread.h"

namespace sweep_guard_ros {

BackgroundThread::~BackgroundThread() {
  {
    const sweep_guard_core::Lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void BackgroundThread::start(Supervisor& supervisor, const ThreadTraits& traits) {
  top_ = &supervisor.add(traits);
  thread_ = std::thread([this] { loop(); });
}

void BackgroundThread::replace(std::function<void()> work) {
  {
    const sweep_guard_core::Lock lock(mutex_);
    std::swap(work_, work);
  }
  changed_.notify_one();
}

void BackgroundThread::loop() {
  top_->enter();
  lower_();
  sweep_guard_core::Lock lock(mutex_);
  while (true) {
    while (!stopping_ && !work_) changed_.wait(lock);
    if (stopping_) return;
    std::function<void()> work = std::exchange(work_, nullptr);
    lock.unlock();
    top_->run(work);
    work = nullptr;
    lock.lock();
  }
}

}  // namespace sweep_guard_ros
