#include "ros/work_queue.h"

#include <atomic>
#include <iterator>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxPoses = 65536;  // 65 s at 1 kHz
constexpr size_t kMaxTaken = 4096;   // PoseHistory keeps them all
constexpr size_t kMaxTasks = 16;

}  // namespace

bool WorkQueue::push(QueuedPose pose) {
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    full = work_.poses.size() == kMaxPoses;
    if (full) work_.poses.pop_back();
    work_.poses.push_back(std::move(pose));
  }
  changed_.notify_all();
  return !full;
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

void WorkQueue::run(const std::function<void()>& task, sweep_guard_core::Duration timeout) {
  const auto decided = std::make_shared<std::atomic<bool>>(false);  // to run it, or to drop it
  std::future<void> done = submit<void>([&task, decided] {
    if (!decided->exchange(true)) task();
  });
  const bool in_time = done.wait_for(timeout) == std::future_status::ready;
  if (!in_time && !decided->exchange(true)) throw sweep_guard_core::Error("the guard is stuck in a sweep");
  done.get();
}

bool WorkQueue::take(Work& taken) {
  taken.tasks.clear();
  taken.poses.clear();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !work_.poses.empty() || !work_.tasks.empty(); });
    if (stopping_) return false;
    std::swap(taken, work_);
    leave(taken);
    if (!taken.poses.empty()) taken_since_ = taken.poses.front().pose.received;
  }
  return true;
}

// Puts back the poses beyond those that may be swept at once.
void WorkQueue::leave(Work& taken) {
  if (taken.poses.size() <= kMaxTaken) return;
  const auto rest = taken.poses.begin() + kMaxTaken;
  work_.poses.assign(std::make_move_iterator(rest), std::make_move_iterator(taken.poses.end()));
  taken.poses.erase(rest, taken.poses.end());
}

void WorkQueue::swept(std::optional<sweep_guard_core::SteadyTime> next) {
  const std::lock_guard lock(mutex_);
  taken_since_ = next;
}

std::optional<sweep_guard_core::SteadyTime> WorkQueue::waitingSince() const {
  const std::lock_guard lock(mutex_);
  if (taken_since_ || work_.poses.empty()) return taken_since_;
  return work_.poses.front().pose.received;
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
