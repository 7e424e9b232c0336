#include "ros/threads/background_thread.h"

namespace sweep_guard_ros {

BackgroundThread::~BackgroundThread() {
  {
    const std::lock_guard lock(mutex_);
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
    const std::lock_guard lock(mutex_);
    std::swap(work_, work);
  }
  changed_.notify_one();
}

void BackgroundThread::loop() {
  top_->enter();
  lower_();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || work_; });
    if (stopping_) return;
    std::function<void()> work = std::exchange(work_, nullptr);
    lock.unlock();
    top_->run(work);
    work = nullptr;
    lock.lock();
  }
}

}  // namespace sweep_guard_ros
