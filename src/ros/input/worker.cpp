#include "ros/input/worker.h"

#include <utility>
#include <vector>

namespace sweep_guard_ros {

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Worker::start() {
  thread_ = std::thread([this] { run(); });
}

void Worker::push(Job job) {
  std::vector<Job> dropped;
  {
    const std::lock_guard lock(mutex_);
    bytes_ += job.bytes;
    jobs_.push_back(std::move(job));
    while (bytes_ > max_bytes_ && jobs_.size() > 1) {
      bytes_ -= jobs_.front().bytes;
      dropped.push_back(std::move(jobs_.front()));
      jobs_.pop_front();
    }
  }
  changed_.notify_all();
  for (const Job& one : dropped) one.drop();
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (stopping_) return;
    {
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      bytes_ -= job.bytes;
      lock.unlock();
      job.run();
    }
    lock.lock();
  }
}

}  // namespace sweep_guard_ros
