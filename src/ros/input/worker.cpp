#include "ros/input/worker.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sweep_guard_ros {
namespace {

constexpr sweep_guard_core::Duration kTimePerByte(100);  // twice what converting a mesh takes

}  // namespace

Worker::~Worker() {
  {
    const sweep_guard_core::Lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Worker::start(Supervisor& supervisor, const ThreadTraits& traits) {
  top_ = &supervisor.add(traits);
  thread_ = std::thread([this] { run(); });
}

// Drops before it pushes: nobody hears of a dropped job after the job that took its place.
void Worker::push(Job job) {
  std::vector<Job> dropped;
  bool fits = true;
  {
    const sweep_guard_core::Lock lock(mutex_);
    while (fits && job.bytes > 0 && bytes_ + job.bytes > max_bytes_) {
      const auto oldest = nextToDrop();
      fits = oldest == jobs_.end() || oldest->replaceable || !job.replaceable;
      if (oldest == jobs_.end() || !fits) break;
      dropped.push_back(std::move(*oldest));
      bytes_ -= dropped.back().bytes;
      jobs_.erase(oldest);
    }
  }
  for (const Job& one : dropped) one.drop();
  if (!fits) return job.drop();
  {
    const sweep_guard_core::Lock lock(mutex_);
    jobs_.push_back(std::move(job));
    bytes_ += jobs_.back().bytes;
  }
  changed_.notify_all();
}

std::deque<Worker::Job>::iterator Worker::nextToDrop() {
  const auto replaceable = [](const Job& job) { return job.replaceable; };
  const auto found = std::find_if(jobs_.begin(), jobs_.end(), replaceable);
  return found != jobs_.end() ? found : jobs_.begin();
}

// A job that runs out of memory counts as dropped.
void Worker::runOrDrop(const Job& job) {
  try {
    job.run();
  } catch (const std::exception&) {
    job.drop();
  }
}

void Worker::run() {
  top_->enter();
  sweep_guard_core::Lock lock(mutex_);
  while (true) {
    while (!stopping_ && jobs_.empty()) changed_.wait(lock);
    if (stopping_) return;
    {
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      bytes_ -= job.bytes;
      lock.unlock();
      top_->run([&] { runOrDrop(job); }, static_cast<std::int64_t>(job.bytes) * kTimePerByte);
    }
    lock.lock();
  }
}

}  // namespace sweep_guard_ros
