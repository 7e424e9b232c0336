#include "ros/guard/guard_thread.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "common/heartbeat.h"
#include "ros/guard/detector_test.h"
#include "ros/parameters/parameter_changes.h"
#include "ros/process/process.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Error;
using sweep_guard_core::SteadyTime;

constexpr Duration kPauseAfterFailure = std::chrono::milliseconds(10);  // before a failed sweep is tried again
constexpr Duration kMaxInterrupted = std::chrono::milliseconds(50);     // from the begin of a prediction on
constexpr Duration kMaxWait = std::chrono::milliseconds(500);  // for a sweep to end, before a change or a reset

}  // namespace

GuardThread::GuardThread(const ros::NodeHandle& private_node, const GuardThreadDependencies& dependencies)
    : dependencies_(dependencies), steps_(private_node, dependencies) {}

void GuardThread::start(Supervisor& supervisor) {
  top_ = &supervisor.add({"guard", sweep_guard_core::Stage::kSweep});
  steps_.setTop(*top_);
  thread_ = std::thread(&GuardThread::run, this);
}

void GuardThread::stop() {
  steps_.guard().stop();
  dependencies_.queue.stop();
  if (thread_.joinable()) thread_.join();
}

// Makes the new parts and destroys the old ones here: the guard's thread only exchanges them.
void GuardThread::apply(const std::shared_ptr<const Parameters>& next) {
  const auto before = dependencies_.parameters.get();
  if (before->attached != next->attached) {
    throw Error("a workpiece was attached or detached meanwhile: ask again; no parameter was changed");
  }
  sweep_guard_core::GuardChange change = changeTo(*next, *before);
  std::optional<ToolShapes> shapes;
  if (!change.bodies.empty()) shapes = dependencies_.make_shapes(*next);
  const auto exchange = [&, tested = change.detector != nullptr] {
    requireUnchanged(*before);
    steps_.guard().exchange(change);
    if (shapes) steps_.setTool(*next, *shapes);
    if (tested) dependencies_.monitor.detectorTested({});
    dependencies_.monitor.setLimits(next->limits);
    dependencies_.monitor.setTool(*next->tool);
    dependencies_.statistics.setCycle(next->guard.cycle);
    dependencies_.parameters.set(next);
  };
  runInTime(exchange, "no parameter was changed");
}

sweep_guard_core::GuardChange GuardThread::changeTo(const Parameters& next, const Parameters& before) {
  sweep_guard_core::GuardChange change;
  change.options = next.guard;
  if (detectorsDiffer(before, next)) {
    auto detector = dependencies_.make_detector(next);
    const std::string failure = testFailure(next, describe(next.detector), *detector);
    if (!failure.empty()) throw sweep_guard_core::DeviceError(failure + ": no parameter was changed");
    change.detector = sampled(std::move(detector), next.detector.name, dependencies_.sampler);
  }
  if (differ(before, next, "prediction/") || differ(before, next, "limits/")) {
    change.predictor.emplace(next.guard.predictor, articulatedRobot(next));
  }
  if (differ(before, next, "tool/")) {
    change.bodies = *next.bodies;
    change.robot = articulatedRobot(next);
  }
  return change;
}

// Of a change that was made from these parameters. In the guard's thread, where nothing else changes them.
void GuardThread::requireUnchanged(const Parameters& before) const {
  if (dependencies_.parameters.get().get() != &before) throw Error("parameters have changed meanwhile: ask again");
}

void GuardThread::reset() {
  sweep_guard_core::GuardChange change;
  const auto parameters = dependencies_.parameters.get();
  change.options = parameters->guard;
  change.predictor.emplace(change.options.predictor, articulatedRobot(*parameters));
  const auto begin_anew = [&] {
    requireUnchanged(*parameters);
    steps_.forget();
    steps_.guard().exchange(change);
    dependencies_.intentions.clear();
  };
  runInTime(begin_anew, "nothing was reset");
  dependencies_.statistics.restart();
}

void GuardThread::exchangeTool(const std::shared_ptr<const Parameters>& before,
                               const std::shared_ptr<const Parameters>& next,
                               const std::function<void()>& change_store) {
  sweep_guard_core::GuardChange change;
  change.options = next->guard;
  change.bodies = *next->bodies;
  change.robot = articulatedRobot(*next);
  ToolShapes shapes = dependencies_.make_shapes(*next);
  const auto exchange = [&] {
    requireUnchanged(*before);
    change_store();
    dependencies_.parameters.set(next);  // before the poses of the next epoch are computed
    steps_.forget();
    steps_.guard().exchange(change);
    dependencies_.intentions.clear();
    steps_.setTool(*next, shapes);
    dependencies_.monitor.setTool(*next->tool);
    dependencies_.scene.setTool(*next->bodies);
  };
  runInTime(exchange, "the tool is as before");
  dependencies_.warnings.publishIfChanged();
}

std::future<sweep_guard_core::PoseWithFrames> GuardThread::newestPose() {
  return dependencies_.queue.submit<sweep_guard_core::PoseWithFrames>([this] { return steps_.freshPose().pose; });
}

void GuardThread::setTrajectory(const std::shared_ptr<const sweep_guard_core::JointTrajectory>& trajectory) {
  dependencies_.queue.submit<void>([this, trajectory] { steps_.guard().setTrajectory(trajectory); });
}

std::string GuardThread::acknowledge(const std::string& id) {
  std::string acknowledged;
  runInTime([&] { acknowledged = steps_.acknowledge(id); }, "nothing was acknowledged");
  dependencies_.warnings.publishIfChanged();
  return acknowledged;
}

void GuardThread::runInTime(const std::function<void()>& task, const std::string& otherwise) {
  try {
    dependencies_.queue.run(task, kMaxWait);
  } catch (const std::future_error&) {
    throw Error("the guard is shutting down: " + otherwise);
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + ": " + otherwise);
  }
}

std::future<PredictService::Motion> GuardThread::predictMotion(Duration horizon) {
  return dependencies_.queue.submit<PredictService::Motion>([this, horizon] { return steps_.motion(horizon); });
}

void GuardThread::setPriority() const {
  const int priority = dependencies_.parameters.initial().realtime_priority;
  if (priority == 0) return;
  const std::string refusal = requestRealTime(priority, "timing/realtime_priority");
  if (!refusal.empty()) ROS_WARN("%s", refusal.c_str());
}

// No pose is left out: what the tool met on the way to it would be, too. One that fails is tried again, and the others wait, so
// nothing is clear meanwhile.
void GuardThread::run() {
  top_->enter();
  top_->attempt([this] { setPriority(); });
  while (hasPose()) {
    bool taken = false;
    {
      const ThreadTop::Piece piece(*top_);
      taken = takeNext();
    }
    if (taken) {
      predictIfDue();
    } else if (!pauseAfterFailure()) {
      return;
    }
  }
}

// Waits for a pose. Meanwhile predicts, until there is other work or it is too early for the next prediction, and runs what is not a
// pose. Returns false after stop().
bool GuardThread::hasPose() {
  while (next_ == work_.poses.size()) {
    dependencies_.queue.swept({});
    const bool predicted = predictIfDue();
    if (next_ < work_.poses.size()) return true;
    if ((!predicted || dependencies_.queue.hasWork()) && !takeWork()) return false;
  }
  return true;
}

// Waits for work, or until a prediction is due. Runs what is not a pose. Returns false after stop().
bool GuardThread::takeWork() {
  next_ = 0;
  try {
    if (!dependencies_.queue.take(work_, latestPrediction())) return false;
  } catch (...) {  // no memory for the poses, which stay in the queue
    top_->caught();
    work_ = {};
  }
  for (const auto& task : work_.tasks) top_->run(task);
  show(work_.images);
  if (work_.frames_moved && work_.poses.empty()) top_->run([this] { steps_.sweepOn(); });
  return true;
}

// Tasks run between two tries: a reset drops the pose, a new parameter may end the failure. Returns false after stop().
bool GuardThread::pauseAfterFailure() {
  if (dependencies_.queue.stopped()) return false;
  std::this_thread::sleep_for(kPauseAfterFailure);
  for (const auto& task : dependencies_.queue.takeTasks()) top_->run(task);
  show(dependencies_.queue.takeImages());
  return true;
}

void GuardThread::show(const std::vector<std::shared_ptr<const sweep_guard_core::Workpiece>>& images) {
  for (const auto& image : images) top_->run([&] { steps_.show(image); });
}

// Sweeps to the next pose, or passes it. Returns false if that failed: it is the next one still.
bool GuardThread::takeNext() {
  try {
    const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kSweep);
    sweep_guard_core::QueuedPose& pose = work_.poses[next_];
    const sweep_guard_core::QueuedPose* const next = next_ + 1 < work_.poses.size() ? &pose + 1 : nullptr;
    const GuardSteps::Taken taken = steps_.take(pose, next);
    if (taken == GuardSteps::Taken::kToSweep) steps_.sweep(pose);
    ++next_;
    if (taken != GuardSteps::Taken::kOutdated) pace_.received(pose.pose.received);
    if (taken == GuardSteps::Taken::kToSweep)
      dependencies_.queue.swept(next != nullptr ? std::optional(next->pose.received) : std::nullopt);
    return true;
  } catch (...) {
    top_->caught();
    return false;
  }
}

// Sweeps of queued poses go first, but delay the prediction by at most a cycle. It begins at a swept pose. One with other triangles
// does not wait for its turn: those from before stand in for them only for a while.
bool GuardThread::timeToPredict() const {
  if (!steps_.mayPredict()) return false;
  const SteadyTime at = std::chrono::steady_clock::now();
  if (at - predicted_at_ >= dependencies_.parameters.get()->guard.cycle) return true;
  return (steps_.trianglesAreNew() || at >= pace_.due()) && !dependencies_.queue.hasPoses();
}

// Returns whether one was due.
bool GuardThread::predictIfDue() {
  if (!timeToPredict()) return false;
  top_->run([this] { predict(); });
  return true;
}

// A prediction rather begins at the next pose, which is fresh, but waits for it no longer than this.
std::optional<SteadyTime> GuardThread::latestPrediction() const {
  if (!steps_.mayPredict()) return std::nullopt;
  return std::min(predicted_at_ + dependencies_.parameters.get()->guard.cycle, pace_.dueAfterNext());
}

// Sweeps to the poses, and against the images, that come meanwhile between two steps, as long as no pose fails.
void GuardThread::predict() {
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kPrediction);
  sweep_guard_core::beat();
  const sweep_guard_core::Instant at = now();
  predicted_at_ = at.steady;
  if (!steps_.choosePose(at)) return;
  RunningPrediction running = steps_.beginPrediction(at, pace_);
  bool interruptible = true;
  for (; !running.run.done(); running.run.step()) {
    const bool waits = next_ < work_.poses.size() || dependencies_.queue.hasPoses() || dependencies_.queue.hasImages();
    if (!interruptible || !waits) continue;
    const SteadyTime begin = std::chrono::steady_clock::now();
    interruptible = sweepWaiting();
    steps_.resumePrediction();
    running.charge.interrupted += std::chrono::steady_clock::now() - begin;
  }
  steps_.endPrediction(running);
}

// Returns whether there are more poses. Without memory for them they stay in the queue.
bool GuardThread::takeMore() {
  next_ = 0;
  try {
    dependencies_.queue.takePoses(work_.poses);
  } catch (...) {
    top_->caught();
    work_.poses.clear();
  }
  return !work_.poses.empty();
}

// Sweeps against the images and to the poses that wait. Returns false if a pose failed. It and those after it wait.
bool GuardThread::sweepWaiting() {
  while (std::chrono::steady_clock::now() - predicted_at_ < kMaxInterrupted) {
    show(dependencies_.queue.takeImages());
    if (next_ == work_.poses.size() && !takeMore()) return true;
    if (!takeNext()) return false;
  }
  return true;
}

}  // namespace sweep_guard_ros
