#include "sweep_guard/ros/sweeper.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"
#include "sweep_guard/ros/real_time.h"

namespace sweep_guard_ros {
namespace {

// A pose that is passed is swept where the next one is.
bool knowsAllFramesOf(const PlacedPose& placed, const PlacedPose& next) {
  const auto& frames = placed.pose.X_WM;
  return std::all_of(frames.begin(), frames.end(),
                     [&](const auto& frame) { return next.pose.X_WM.count(frame.first) != 0; });
}

}  // namespace

Sweeper::Sweeper(const ros::NodeHandle& private_node, const SweeperParts& parts)
    : parts_(parts),
      findings_(private_node, parts.parameters),
      guard_(
          *parts.parameters.initial().tool,
          sweep_guard::makeDetector(parts.parameters.initial().detector, parts.parameters.initial().detector_options),
          parts.parameters.initial().guard) {}

void Sweeper::start() {
  thread_ = std::thread([this] { work(); });
}

void Sweeper::stop() {
  queue_.stop();
  if (thread_.joinable()) thread_.join();
}

void Sweeper::sweepTo(PlacedPose pose) {
  if (parts_.ledger.counts(pose.came)) queue_.push(std::move(pose));
}

// What takes time is made here, and what it replaces is destroyed here: the sweeping thread only exchanges them.
void Sweeper::adopt(const std::shared_ptr<const Parameters>& next) {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard::GuardChange change;
  change.options = next->guard;
  const auto before = parts_.parameters.get();
  if (detectorsDiffer(*before, *next)) {
    change.detector = sweep_guard::makeDetector(next->detector, next->detector_options);
  }
  if (differ(*before, *next, "prediction/") || differ(*before, *next, "limits/")) {
    change.predictor.emplace(next->guard.predictor);
  }
  if (differ(*before, *next, "tool/")) change.tool = *next->tool;
  const auto exchange = [&] {
    guard_.adopt(change);
    parts_.ledger.setLimits(next->limits);
    parts_.workload.setCycle(next->guard.cycle);
    parts_.parameters.set(next);
  };
  queue_.ask<void>(exchange).get();
}

void Sweeper::reset() {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard::GuardChange change;
  change.options = parts_.parameters.get()->guard;
  change.predictor.emplace(change.options.predictor);
  parts_.ledger.restart();
  const auto forget = [&] {
    guard_.forget();
    guard_.adopt(change);
    passed_.clear();
    swept_.reset();
    parts_.scene.clear();
  };
  queue_.ask<void>(forget).get();
  parts_.workload.restart();
}

std::future<PredictService::Answer> Sweeper::forecast(sweep_guard::Duration horizon) {
  return queue_.ask<PredictService::Answer>([this, horizon] { return answer(horizon); });
}

void Sweeper::work() {
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

void Sweeper::process(const std::vector<PlacedPose>& poses) {
  for (size_t i = 0; i < poses.size(); ++i) process(poses[i], i + 1 < poses.size() ? &poses[i + 1] : nullptr);
}

// @param next  if it waits already
void Sweeper::process(const PlacedPose& placed, const PlacedPose* next) {
  if (!parts_.ledger.counts(placed.came)) return;
  if (placed.came.epoch != guard_epoch_) {
    guard_.forget();
    passed_.clear();
  }
  guard_epoch_ = placed.came.epoch;
  try {
    if (next != nullptr && knowsAllFramesOf(placed, *next)) return pass(placed);
    sweep(placed);
    if (timeToLookAhead()) lookAhead(placed);
  } catch (const std::exception& error) {  // no memory for the report or its messages
    const std::string story = std::string("sweeping failed: ") + error.what();
    parts_.ledger.fault(sweep_guard::kDetectorFault, story);
    parts_.workload.failed(story);
  }
}

void Sweeper::pass(const PlacedPose& placed) {
  guard_.pass(placed.pose);
  passed_.push_back(placed.pose.received);
  parts_.scene.passed(placed.pose);
}

void Sweeper::sweep(const PlacedPose& placed) {
  const sweep_guard::ToolPose& pose = placed.pose;
  const sweep_guard::SteadyTime begin = std::chrono::steady_clock::now();
  const auto report = reports_.take();
  guard_.sweep(pose, parts_.workpieces.snapshot(), *report);
  const sweep_guard::SteadyTime swept = std::chrono::steady_clock::now();
  swept_ = {pose.stamp, pose.received};
  if (!report->objects.empty()) findings_.publish(*report, guard_.tool());
  parts_.ledger.swept(*report, *swept_, placed.came, swept);
  parts_.warnings.warnOfChange();

  const sweep_guard::SteadyTime warned = std::chrono::steady_clock::now();
  for (const sweep_guard::SteadyTime received : passed_) parts_.workload.swept(warned - received, {});
  passed_.clear();
  parts_.workload.swept(warned - pose.received, swept - begin);
  for (const auto& failure : report->failures) tellFailure(failure);
  parts_.scene.swept(pose, report);
}

void Sweeper::tellFailure(const sweep_guard::SweepFailure& failure) {
  parts_.workload.failed("'" + failure.workpiece->id + "': " + failure.reason);
  log_.error(failure.workpiece->id, "detection failed: " + failure.reason);
}

// Poses that wait go first, so that each is swept at most one look ahead late; but not for longer than a cycle.
bool Sweeper::timeToLookAhead() const {
  const sweep_guard::Duration cycle = parts_.parameters.get()->guard.cycle;
  return std::chrono::steady_clock::now() - looked_ahead_ >= cycle || queue_.noPoseWaits();
}

void Sweeper::lookAhead(const PlacedPose& placed) {
  const sweep_guard::Instant at = now();
  looked_ahead_ = at.steady;
  const sweep_guard::Duration age = std::max(sweep_guard::age(*swept_, at), sweep_guard::Duration::zero());
  const auto outlook = outlooks_.take();
  guard_.lookAhead(age, parts_.workpieces.snapshot(), *outlook);
  const sweep_guard::SteadyTime looked = std::chrono::steady_clock::now();
  parts_.ledger.predicted(*outlook, *swept_, placed.came, now());
  parts_.warnings.warnOfChange();
  findings_.publish(*outlook, age);

  parts_.workload.predicted({std::chrono::steady_clock::now() - placed.pose.received, looked - at.steady,
                             outlook->sweeps_made, outlook->sweeps_asked,
                             outlook->coveredUntil() - outlook->stamp - age, outlook->probability()});
  for (const auto& failure : outlook->failures) tellFailure(failure);
  parts_.scene.lookedAhead(placed.pose, outlook);
}

PredictService::Answer Sweeper::answer(sweep_guard::Duration horizon) const {
  const sweep_guard::Instant at = now();
  const sweep_guard::Ledger& ledger = parts_.ledger;
  if (const auto asked_by = ledger.disabledBy()) throw sweep_guard::Error("the guard is disabled by " + *asked_by);
  if (!swept_ || guard_epoch_ != ledger.mark().epoch) throw sweep_guard::Error("no tool pose yet: nothing is known");
  if (sweep_guard::stale(*swept_, at, parts_.parameters.get()->limits.pose_timeout)) {
    throw sweep_guard::Error("the newest tool pose is stale: nothing is known of the tool now");
  }
  const sweep_guard::Duration age = std::max(sweep_guard::age(*swept_, at), sweep_guard::Duration::zero());
  sweep_guard::Forecast forecast = guard_.forecast(age, horizon);
  if (forecast.path.empty())
    throw sweep_guard::Error("the motion is not known yet: two tool poses in a row are needed");
  return {std::move(forecast), age};
}

}  // namespace sweep_guard_ros
