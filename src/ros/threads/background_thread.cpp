#include "ros/threads/background_thread.h"

#include <utility>

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

void BackgroundThread::run(std::function<void()> work) {
  std::packaged_task<void()> task(std::move(work));
  std::future<void> done = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    work_ = std::move(task);
  }
  changed_.notify_one();
  done.get();
}

void BackgroundThread::loop() {
  top_->enter();
  lower_();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || work_.valid(); });
    if (stopping_) return;
    std::packaged_task<void()> work = std::exchange(work_, {});
    lock.unlock();
    top_->run([&] { work(); });
    lock.lock();
  }
}

}  // namespace sweep_guard_ros
