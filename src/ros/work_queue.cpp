#include "ros/work_queue.h"

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxPoses = 4096;  // swept at once; later poses wait in the input, which drops none
constexpr size_t kMaxTasks = 16;

}  // namespace

void WorkQueue::push(QueuedPose pose) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || work_.poses.size() < kMaxPoses; });
    work_.poses.push_back(std::move(pose));
  }
  changed_.notify_all();
}

void WorkQueue::pushTask(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) throw sweep_guard_core::Error("the guard is shutting down");
    if (work_.tasks.size() >= kMaxTasks) throw sweep_guard_core::Error("the guard is busy: ask again");
    work_.tasks.push_back(std::move(task));
  }
  changed_.notify_all();
}

bool WorkQueue::take(Work& taken) {
  taken.tasks.clear();
  taken.poses.clear();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !work_.poses.empty() || !work_.tasks.empty(); });
    if (stopping_) return false;
    std::swap(taken, work_);
  }
  changed_.notify_all();
  return true;
}

bool WorkQueue::hasPoses() const {
  const std::lock_guard lock(mutex_);
  return !work_.poses.empty();
}

void WorkQueue::stop() {
  Work dropped;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    std::swap(dropped, work_);
  }
  changed_.notify_all();
}

}  // namespace sweep_guard_ros
