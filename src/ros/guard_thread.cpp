#include "ros/guard_thread.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "ros/real_time.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

// A pose that is passed is swept where the next one is.
bool knowsAllFramesOf(const QueuedPose& placed, const QueuedPose& next) {
  const auto& frames = placed.pose.X_WM;
  return std::all_of(frames.begin(), frames.end(),
                     [&](const auto& frame) { return next.pose.X_WM.count(frame.first) != 0; });
}

}  // namespace

GuardThread::GuardThread(const ros::NodeHandle& private_node, const GuardThreadDependencies& parts)
    : parts_(parts),
      findings_(private_node, parts.parameters),
      guard_(*parts.parameters.initial().tool,
             sweep_guard_core::makeDetector(parts.parameters.initial().detector,
                                            parts.parameters.initial().detector_options),
             parts.parameters.initial().guard) {}

void GuardThread::start() {
  thread_ = std::thread([this] { work(); });
}

void GuardThread::stop() {
  queue_.stop();
  if (thread_.joinable()) thread_.join();
}

void GuardThread::sweepTo(QueuedPose pose) {
  if (parts_.monitor.counts(pose.came)) queue_.push(std::move(pose));
}

// What takes time is made here, and what it replaces is destroyed here: the sweeping thread only exchanges them.
void GuardThread::adopt(const std::shared_ptr<const Parameters>& next) {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard_core::GuardChange change;
  change.options = next->guard;
  const auto before = parts_.parameters.get();
  if (detectorsDiffer(*before, *next)) {
    change.detector = sweep_guard_core::makeDetector(next->detector, next->detector_options);
  }
  if (differ(*before, *next, "prediction/") || differ(*before, *next, "limits/")) {
    change.predictor.emplace(next->guard.predictor);
  }
  if (differ(*before, *next, "tool/")) change.tool = *next->tool;
  const auto exchange = [&] {
    guard_.exchange(change);
    parts_.monitor.setLimits(next->limits);
    parts_.statistics.setCycle(next->guard.cycle);
    parts_.parameters.set(next);
  };
  queue_.ask<void>(exchange).get();
}

void GuardThread::reset() {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard_core::GuardChange change;
  change.options = parts_.parameters.get()->guard;
  change.predictor.emplace(change.options.predictor);
  parts_.monitor.restart();
  const auto forget = [&] {
    guard_.reset();
    guard_.exchange(change);
    passed_.clear();
    swept_.reset();
    parts_.scene.clear();
  };
  queue_.ask<void>(forget).get();
  parts_.statistics.restart();
}

std::future<PredictService::Answer> GuardThread::predictMotion(sweep_guard_core::Duration horizon) {
  return queue_.ask<PredictService::Answer>([this, horizon] { return answer(horizon); });
}

void GuardThread::work() {
  const int priority = parts_.parameters.initial().realtime_priority;
  if (priority > 0) {
    const std::string refusal = askForRealTime(priority);
    if (!refusal.empty()) ROS_WARN("%s", refusal.c_str());
  }
  WorkQueue::Work waiting;
  while (queue_.take(waiting)) {
    for (const auto& task : waiting.tasks) task();
    process(waiting.poses);
  }
}

void GuardThread::process(const std::vector<QueuedPose>& poses) {
  for (size_t i = 0; i < poses.size(); ++i) process(poses[i], i + 1 < poses.size() ? &poses[i + 1] : nullptr);
}

// @param next  if it waits already
void GuardThread::process(const QueuedPose& placed, const QueuedPose* next) {
  if (!parts_.monitor.counts(placed.came)) return;
  if (placed.came.epoch != guard_epoch_) {
    guard_.reset();
    passed_.clear();
  }
  guard_epoch_ = placed.came.epoch;
  try {
    if (next != nullptr && knowsAllFramesOf(placed, *next)) return pass(placed);
    sweep(placed);
    if (timeToPredict()) predict(placed);
  } catch (const std::exception& error) {  // no memory for the report or its messages
    const std::string story = std::string("sweeping failed: ") + error.what();
    parts_.monitor.fault(sweep_guard_core::kDetectorFault, story);
    parts_.statistics.failed(story);
  }
}

void GuardThread::pass(const QueuedPose& placed) {
  guard_.pass(placed.pose);
  passed_.push_back(placed.pose.received);
  parts_.scene.passed(placed.pose);
}

void GuardThread::sweep(const QueuedPose& placed) {
  const sweep_guard_core::PoseWithFrames& pose = placed.pose;
  const sweep_guard_core::SteadyTime begin = std::chrono::steady_clock::now();
  const auto report = reports_.take();
  guard_.sweep(pose, parts_.workpieces.snapshot(), *report);
  const sweep_guard_core::SteadyTime swept = std::chrono::steady_clock::now();
  swept_ = {pose.stamp, pose.received};
  if (!report->objects.empty()) findings_.publish(*report, guard_.tool());
  parts_.monitor.swept(*report, *swept_, placed.came, swept);
  parts_.warnings.warnOfChange();

  const sweep_guard_core::SteadyTime warned = std::chrono::steady_clock::now();
  for (const sweep_guard_core::SteadyTime received : passed_) parts_.statistics.swept(warned - received, {});
  passed_.clear();
  parts_.statistics.swept(warned - pose.received, swept - begin);
  for (const auto& failure : report->failures) reportFailure(failure);
  parts_.scene.swept(pose, report);
}

void GuardThread::reportFailure(const sweep_guard_core::SweepFailure& failure) {
  parts_.statistics.failed("'" + failure.workpiece->id + "': " + failure.reason);
  log_.error(failure.workpiece->id, "detection failed: " + failure.reason);
}

// Poses that wait go first, so that each is swept at most one look ahead late; but not for longer than a cycle.
bool GuardThread::timeToPredict() const {
  const sweep_guard_core::Duration cycle = parts_.parameters.get()->guard.cycle;
  return std::chrono::steady_clock::now() - predicted_at_ >= cycle || queue_.noPoseWaits();
}

void GuardThread::predict(const QueuedPose& placed) {
  const sweep_guard_core::Instant at = now();
  predicted_at_ = at.steady;
  const sweep_guard_core::Duration age =
      std::max(sweep_guard_core::age(*swept_, at), sweep_guard_core::Duration::zero());
  const auto prediction = predictions_.take();
  guard_.predict(age, parts_.workpieces.snapshot(), *prediction);
  const sweep_guard_core::SteadyTime looked = std::chrono::steady_clock::now();
  parts_.monitor.predicted(*prediction, *swept_, placed.came, now());
  parts_.warnings.warnOfChange();
  findings_.publish(*prediction, age);

  parts_.statistics.predicted({std::chrono::steady_clock::now() - placed.pose.received, looked - at.steady,
                               prediction->sweeps_made, prediction->sweeps_asked,
                               prediction->coveredUntil() - prediction->stamp - age, prediction->probability()});
  for (const auto& failure : prediction->failures) reportFailure(failure);
  parts_.scene.predicted(placed.pose, prediction);
}

PredictService::Answer GuardThread::answer(sweep_guard_core::Duration horizon) const {
  const sweep_guard_core::Instant at = now();
  const sweep_guard_core::WarningMonitor& monitor = parts_.monitor;
  if (const auto asked_by = monitor.disabledBy())
    throw sweep_guard_core::Error("the guard is disabled by " + *asked_by);
  if (!swept_ || guard_epoch_ != monitor.checkpoint().epoch)
    throw sweep_guard_core::Error("no tool pose yet: nothing is known");
  if (sweep_guard_core::stale(*swept_, at, parts_.parameters.get()->limits.pose_timeout)) {
    throw sweep_guard_core::Error("the newest tool pose is stale: nothing is known of the tool now");
  }
  const sweep_guard_core::Duration age =
      std::max(sweep_guard_core::age(*swept_, at), sweep_guard_core::Duration::zero());
  sweep_guard_core::PredictedMotion predictMotion = guard_.predictMotion(age, horizon);
  if (predictMotion.path.empty())
    throw sweep_guard_core::Error("the motion is not known yet: two tool poses in a row are needed");
  return {std::move(predictMotion), age};
}

}  // namespace sweep_guard_ros
