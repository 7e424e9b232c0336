#include "monitor/work_queue.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <iterator>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxPoses = 65536;  // 65 s at 1 kHz
constexpr size_t kMaxTaken = 4096;   // PoseHistory keeps them all
constexpr size_t kMaxTasks = 16;
constexpr size_t kMaxImages = 16;  // each some megabytes

}  // namespace

bool WorkQueue::push(QueuedPose pose) {
  bool full = false;
  {
    const Lock lock(mutex_);
    full = work_.poses.size() == kMaxPoses;
    if (full) work_.poses.pop_back();
    work_.poses.push_back(std::move(pose));
    wake();
  }
  return !full;
}

bool WorkQueue::show(std::shared_ptr<const Workpiece> image) {
  const Lock lock(mutex_);
  if (stopping_ || work_.images.size() >= kMaxImages) return false;
  work_.images.push_back(std::move(image));
  wake();
  return true;
}

void WorkQueue::framesMoved() {
  const Lock lock(mutex_);
  work_.frames_moved = true;
  wake();
}

void WorkQueue::pushTask(std::function<void()> task) {
  {
    const Lock lock(mutex_);
    if (stopping_) throw Error("the guard is shutting down");
    if (work_.tasks.size() >= kMaxTasks) throw Error("the guard is busy: ask again");
    work_.tasks.push_back(std::move(task));
    wake();
  }
}

void WorkQueue::run(const std::function<void()>& task, Duration timeout) {
  const auto decided = std::make_shared<std::atomic<bool>>(false);  // to run it, or to drop it
  std::future<void> done = submit<void>([&task, decided] {
    if (!decided->exchange(true)) task();
  });
  const bool in_time = done.wait_for(timeout) == std::future_status::ready;
  if (!in_time && !decided->exchange(true)) throw Error("the guard is stuck in a sweep");
  done.get();
}

bool WorkQueue::take(Work& taken, std::optional<SteadyTime> until) {
  taken.tasks.clear();
  taken.images.clear();
  while (!takeNow(taken)) {
    if (!wait(until)) return true;
  }
  return !taken.poses.empty() || !taken.tasks.empty() || !taken.images.empty() || taken.frames_moved;
}

// Returns false if it is too late. May return before there is work.
bool WorkQueue::wait(std::optional<SteadyTime> until) {
  if (!until) {
    sem_wait(&signal_);
    return true;
  }
  const auto since_boot = until->time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_boot);
  const timespec at{seconds.count(), std::chrono::nanoseconds(since_boot - seconds).count()};
  return sem_clockwait(&signal_, CLOCK_MONOTONIC, &at) == 0 || errno != ETIMEDOUT;
}

// Returns false if the thread has to wait. After stop(), what is taken is empty.
bool WorkQueue::takeNow(Work& taken) {
  const Lock lock(mutex_);
  taken.poses.clear();
  taken.frames_moved = false;
  if (stopping_) return true;
  takePosesNow(taken.poses);
  std::swap(taken.tasks, work_.tasks);
  std::swap(taken.images, work_.images);
  taken.frames_moved = std::exchange(work_.frames_moved, false);
  waiting_ = taken.poses.empty() && taken.tasks.empty() && taken.images.empty() && !taken.frames_moved;
  return !waiting_;
}

void WorkQueue::takePoses(std::vector<QueuedPose>& taken) {
  const Lock lock(mutex_);
  takePosesNow(taken);
}

std::vector<std::shared_ptr<const Workpiece>> WorkQueue::takeImages() {
  const Lock lock(mutex_);
  return std::exchange(work_.images, {});
}

std::vector<std::function<void()>> WorkQueue::takeTasks() {
  const Lock lock(mutex_);
  return std::exchange(work_.tasks, {});
}

void WorkQueue::wake() {
  if (waiting_) sem_post(&signal_);
  waiting_ = false;
}

// Takes those that may be swept at once. No pose is lost if there is no memory for them.
void WorkQueue::takePosesNow(std::vector<QueuedPose>& taken) {
  taken.clear();
  if (work_.poses.size() <= kMaxTaken) {
    std::swap(taken, work_.poses);
  } else {
    const auto rest = work_.poses.begin() + kMaxTaken;
    taken.assign(std::make_move_iterator(work_.poses.begin()), std::make_move_iterator(rest));
    work_.poses.erase(work_.poses.begin(), rest);
  }
  if (!taken.empty()) taken_since_ = taken.front().pose.received;
}

void WorkQueue::swept(std::optional<SteadyTime> next) {
  const Lock lock(mutex_);
  taken_since_ = next;
}

std::optional<SteadyTime> WorkQueue::waitingSince() const {
  const Lock lock(mutex_);
  if (taken_since_ || work_.poses.empty()) return taken_since_;
  return work_.poses.front().pose.received;
}

bool WorkQueue::hasPoses() const {
  const Lock lock(mutex_);
  return !work_.poses.empty();
}

bool WorkQueue::hasImages() const {
  const Lock lock(mutex_);
  return !work_.images.empty();
}

bool WorkQueue::hasWork() const {
  const Lock lock(mutex_);
  return !work_.poses.empty() || !work_.tasks.empty() || !work_.images.empty() || work_.frames_moved;
}

bool WorkQueue::stopped() const {
  const Lock lock(mutex_);
  return stopping_;
}

void WorkQueue::stop() {
  Work dropped;
  {
    const Lock lock(mutex_);
    stopping_ = true;
    std::swap(dropped, work_);
    wake();
  }
}

}  // namespace sweep_guard_core
