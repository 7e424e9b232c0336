#include "ros/guard/guard_thread.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "common/heartbeat.h"
#include "ros/guard/detector_test.h"
#include "ros/process/process.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Error;
using sweep_guard_core::Instant;
using sweep_guard_core::PredictionInterval;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Timestamps;

constexpr Duration kPauseAfterFailure = std::chrono::milliseconds(10);  // before a failed sweep is tried again
constexpr Duration kMaxInterrupted = std::chrono::milliseconds(50);     // from the begin of a prediction on
constexpr Duration kSilent = std::chrono::seconds(4);                   // of a frame: others do not wait for it
constexpr Duration kMaxWait = std::chrono::milliseconds(500);  // for a sweep to end, before a change or a reset

// A passed pose is swept as a part of the motion to the next one.
bool knowsAllFramesOf(const sweep_guard_core::QueuedPose& queued, const sweep_guard_core::QueuedPose& next) {
  const auto& frames = queued.pose.X_WM;
  return std::all_of(frames.begin(), frames.end(),
                     [&](const auto& frame) { return next.pose.X_WM.count(frame.first) != 0; });
}

// Of deformations they are the same.
bool haveSameTriangles(const sweep_guard_core::Workpieces& some, const sweep_guard_core::Workpieces& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(), [](const auto& one, const auto& other) {
    return &one->mesh_M.triangles() == &other->mesh_M.triangles() && one->frame == other->frame;
  });
}

std::unique_ptr<sweep_guard_core::Detector> firstDetector(const GuardThreadDependencies& dependencies) {
  const Parameters& parameters = dependencies.parameters.initial();
  auto detector = dependencies.make_detector(parameters);
  const std::string failure = testFailure(parameters, describe(parameters.detector), *detector);
  if (!failure.empty() && parameters.self_test == SelfTest::kExit) throw sweep_guard_core::DeviceError(failure);
  if (!failure.empty()) ROS_ERROR("%s", failure.c_str());
  dependencies.monitor.detectorTested(failure);
  return sampled(std::move(detector), parameters.detector.name, dependencies.sampler);
}

sweep_guard_core::Guard guardOf(const Parameters& parameters, std::unique_ptr<sweep_guard_core::Detector> detector) {
  if (parameters.articulated) return {articulatedRobot(parameters), std::move(detector), parameters.guard};
  return {*parameters.tool, std::move(detector), parameters.guard};
}

Timestamps timestampsOf(const sweep_guard_core::PoseWithFrames& pose) { return {pose.stamp, pose.received}; }

sweep_guard_core::StampedPose stampedPoseOf(const sweep_guard_core::PoseWithFrames& pose) {
  return {pose.stamp, pose.X_WT};
}

// Of queries about what the tool will do.
sweep_guard_core::QueryOrigin predictedFrom(const sweep_guard_core::PoseWithFrames& pose, std::uint64_t epoch) {
  return {/*measured=*/false, epoch, stampedPoseOf(pose), stampedPoseOf(pose)};
}

Duration ageOf(const Timestamps& pose, const Instant& at) { return std::max(age(pose, at), Duration::zero()); }

}  // namespace

ToolShapes::ToolShapes(const Parameters& parameters)
    : pieces(sweep_guard_core::interpenetrationFinders(*parameters.bodies)), surface(surfaceMsg(parameters)) {}

ToolPublishers::ToolPublishers(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                               const sweep_guard_core::WarningMonitor& monitor)
    : proximity(private_node, parameters, monitor),
      interaction(private_node, parameters, monitor),
      bodies(private_node, parameters) {}

void ToolPublishers::setTool(const Parameters& parameters, ToolShapes& shapes) {
  proximity.setTool(*parameters.tool);
  interaction.exchange(shapes.pieces);
  bodies.setTool(*parameters.bodies, shapes.surface);
}

void ToolPublishers::reset() {
  proximity.reset();
  interaction.reset();
  bodies.reset();
}

GuardThread::GuardThread(const ros::NodeHandle& private_node, const GuardThreadDependencies& dependencies)
    : dependencies_(dependencies),
      results_(private_node, dependencies.parameters),
      tool_(private_node, dependencies.parameters, dependencies.monitor),
      guard_(guardOf(dependencies.parameters.initial(), firstDetector(dependencies))),
      acknowledgements_(dependencies.parameters, dependencies.monitor, dependencies.sampler, guard_) {}

void GuardThread::start(Supervisor& supervisor) {
  top_ = &supervisor.add({"guard", sweep_guard_core::Stage::kSweep});
  thread_ = std::thread([this] { run(); });
}

void GuardThread::stop() {
  guard_.stop();
  dependencies_.queue.stop();
  if (thread_.joinable()) thread_.join();
}

// Makes the new parts and destroys the old ones here: the guard's thread only exchanges them.
void GuardThread::apply(const std::shared_ptr<const Parameters>& next) {
  const std::lock_guard lock(change_mutex_);
  const auto before = dependencies_.parameters.get();
  if (before->attached != next->attached) {
    throw Error("a workpiece was attached or detached meanwhile: ask again; no parameter was changed");
  }
  sweep_guard_core::GuardChange change = changeTo(*next, *before);
  std::optional<ToolShapes> shapes;
  if (!change.bodies.empty()) shapes = dependencies_.make_shapes(*next);
  const auto exchange = [&, tested = change.detector != nullptr] {
    guard_.exchange(change);
    if (shapes) tool_.setTool(*next, *shapes);
    if (tested) dependencies_.monitor.detectorTested({});
    dependencies_.monitor.setLimits(next->limits);
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

void GuardThread::reset() {
  const std::lock_guard lock(change_mutex_);
  sweep_guard_core::GuardChange change;
  const auto parameters = dependencies_.parameters.get();
  change.options = parameters->guard;
  change.predictor.emplace(change.options.predictor, articulatedRobot(*parameters));
  const auto begin_anew = [&] {
    forget();
    guard_.exchange(change);
    dependencies_.intentions.clear();
  };
  runInTime(begin_anew, "nothing was reset");
  dependencies_.statistics.restart();
}

// Called by the guard's thread.
void GuardThread::forget() {
  dependencies_.monitor.restart();
  resetMotion();
  swept_.reset();
  prediction_due_ = false;
  dependencies_.scene.clear();
}

void GuardThread::resetMotion() {
  guard_.reset();
  tool_.reset();
  passed_.clear();
  placed_anew_ = {};
}

void GuardThread::exchangeTool(const std::shared_ptr<const Parameters>& before,
                               const std::shared_ptr<const Parameters>& next,
                               const std::function<void()>& change_store) {
  const std::lock_guard lock(change_mutex_);
  sweep_guard_core::GuardChange change;
  change.options = next->guard;
  change.bodies = *next->bodies;
  change.robot = articulatedRobot(*next);
  ToolShapes shapes = dependencies_.make_shapes(*next);
  const auto exchange = [&] {
    if (dependencies_.parameters.get() != before) throw Error("parameters have changed meanwhile: ask again");
    change_store();
    dependencies_.parameters.set(next);  // before the poses of the next epoch are computed
    forget();
    guard_.exchange(change);
    dependencies_.intentions.clear();
    tool_.setTool(*next, shapes);
    dependencies_.scene.setTool(*next->bodies);
  };
  runInTime(exchange, "the tool is as before");
  dependencies_.warnings.publishIfChanged();
}

std::future<sweep_guard_core::PoseWithFrames> GuardThread::newestPose() {
  return dependencies_.queue.submit<sweep_guard_core::PoseWithFrames>([this] { return freshPose().pose; });
}

const sweep_guard_core::QueuedPose& GuardThread::freshPose() const {
  if (const auto asked_by = dependencies_.monitor.disabledBy()) throw Error("the guard is disabled by " + *asked_by);
  if (!swept_ || !dependencies_.monitor.checkpoint().continues(checkpoint_)) throw Error("no tool pose yet");
  if (stale(timestampsOf(swept_->pose), now(), dependencies_.parameters.get()->limits.pose_timeout)) {
    throw Error("newest tool pose is stale: motion is unknown");
  }
  return *swept_;
}

std::string GuardThread::acknowledge(const std::string& id) {
  std::string acknowledged;
  const auto add = [&] {
    const auto origin = predictedFrom(swept_.value_or(sweep_guard_core::QueuedPose()).pose, checkpoint_.epoch);
    acknowledged = acknowledgements_.add(id, dependencies_.workpieces.snapshot(), origin);
  };
  runInTime(add, "nothing was acknowledged");
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
  return dependencies_.queue.submit<PredictService::Motion>([this, horizon] { return motion(horizon); });
}

void GuardThread::setPriority() const {
  const int priority = dependencies_.parameters.initial().realtime_priority;
  if (priority == 0) return;
  const std::string refusal = requestRealTime(priority, "timing/realtime_priority");
  if (!refusal.empty()) ROS_WARN("%s", refusal.c_str());
}

void GuardThread::run() {
  top_->enter();
  top_->attempt([this] { setPriority(); });
  bool more = true;
  while (more) top_->attempt([&] { more = workOnce(); });
}

bool GuardThread::workOnce() {
  next_ = 0;
  if (!dependencies_.queue.take(work_, latestPrediction())) return false;
  for (const auto& task : work_.tasks) top_->run(task);
  if (work_.frames_moved && work_.poses.empty()) top_->run([this] { sweepOn(); });
  do {
    if (!sweepPoses()) return false;
    if (!timeToPredict()) return true;
    top_->run([this] { predict(); });
  } while (next_ < work_.poses.size() || !dependencies_.queue.hasWork());
  return true;
}

// Also those that were taken during a prediction. Returns false after stop().
bool GuardThread::sweepPoses() {
  while (next_ < work_.poses.size()) {
    if (!sweepOrRepeat()) return false;
    if (timeToPredict()) top_->run([this] { predict(); });
  }
  dependencies_.queue.swept({});
  return true;
}

// No pose is left out: what the tool met on the way to it would be, too. The others wait, so nothing is clear meanwhile.
// Tasks run between the tries: a reset drops the pose, a new parameter may end the failure. Returns false after stop().
bool GuardThread::sweepOrRepeat() {
  const size_t pose = next_;
  while (true) {
    top_->run([this] { sweepNext(); });
    if (next_ != pose) return true;
    if (dependencies_.queue.stopped()) return false;
    std::this_thread::sleep_for(kPauseAfterFailure);
    for (const auto& task : dependencies_.queue.takeTasks()) top_->run(task);
  }
}

void GuardThread::sweepNext() {
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kSweep);
  const sweep_guard_core::QueuedPose* const next = next_ + 1 < work_.poses.size() ? &work_.poses[next_ + 1] : nullptr;
  const bool swept = process(work_.poses[next_], next);
  ++next_;
  if (!swept) return;
  prediction_due_ = true;
  dependencies_.queue.swept(next != nullptr ? std::optional(next->pose.received) : std::nullopt);
}

bool GuardThread::takeMore() {
  next_ = 0;
  dependencies_.queue.takePoses(work_.poses);
  return !work_.poses.empty();
}

// Sweeps the poses that wait. Returns false if one failed. It and those after it wait.
bool GuardThread::sweepWaiting() {
  while (std::chrono::steady_clock::now() - predicted_at_ < kMaxInterrupted) {
    if (next_ == work_.poses.size() && !takeMore()) return true;
    const size_t pose = next_;
    top_->attempt([this] { sweepNext(); });
    if (next_ == pose) return false;
  }
  return true;
}

// Returns whether the pose was swept: others are passed, or out of date.
bool GuardThread::process(sweep_guard_core::QueuedPose& queued, const sweep_guard_core::QueuedPose* next) {
  if (!dependencies_.monitor.isToBeSwept(queued.checkpoint)) return false;
  if (!queued.checkpoint.continues(checkpoint_)) resetMotion();
  checkpoint_ = queued.checkpoint;
  const bool is_passed = queued.pose.anew || (next != nullptr && knowsAllFramesOf(queued, *next));
  frames_known_to_ = follow(queued.pose);
  pace_.received(queued.pose.received);
  if (is_passed) {
    pass(queued.pose);
    return false;
  }
  for (const std::string& frame : placed_anew_.frames) queued.pose.drifts.try_emplace(frame);
  try {
    sweep(queued);
  } catch (...) {
    guard_.takeBack();
    throw;
  }
  placed_anew_ = {};
  return true;
}

// Returns the time up to which all frames that are followed are known, but for those that are silent: at most that of the pose.
sweep_guard_core::Time GuardThread::follow(sweep_guard_core::PoseWithFrames& pose) {
  sweep_guard_core::Time known_to = pose.stamp;
  if (dependencies_.frame_motions == nullptr) return known_to;
  frames_ = dependencies_.frame_motions->get();
  sweep_guard_core::placeFollowed(*frames_, pose);
  guard_.follow(frames_);
  for (const auto& [frame, motion] : *frames_) {
    const sweep_guard_core::Time newest = motion->measured.back().stamp;
    const bool counts = motion->goes_on && pose.stamp - newest < kSilent;
    if (counts) known_to = std::min(known_to, newest);
  }
  return known_to;
}

// What is swept of frames is needed no more.
void GuardThread::forgetFrames() {
  if (dependencies_.frame_motions != nullptr) dependencies_.frame_motions->forgetBefore(swept_->pose.stamp, *frames_);
}

void GuardThread::pass(const sweep_guard_core::PoseWithFrames& pose) {
  guard_.pass(pose);
  if (pose.anew) {
    placed_anew_.any = true;
    placed_anew_.frames.insert(pose.anew->frames.begin(), pose.anew->frames.end());
    if (pose.anew->tool) tool_.bodies.reset();
    return tool_.interaction.reset();
  }
  tool_.bodies.moved(pose);
  passed_.push_back(pose.received);
  dependencies_.scene.passed(pose);
}

void GuardThread::sweep(const sweep_guard_core::QueuedPose& queued) {
  const sweep_guard_core::PoseWithFrames& pose = queued.pose;
  const SteadyTime begin = std::chrono::steady_clock::now();
  const auto report = reports_.take();
  const sweep_guard_core::Workpieces workpieces = dependencies_.workpieces.snapshot();
  beginSweep(queued, workpieces);
  guard_.sweep(pose, workpieces, *report);
  const SteadyTime end = std::chrono::steady_clock::now();
  triangles_are_new_ = !haveSameTriangles(workpieces, predicted_with_);
  swept_ = queued;
  warn(*report, queued);

  const SteadyTime warned = std::chrono::steady_clock::now();
  for (const SteadyTime received : passed_) dependencies_.statistics.swept(warned - received, {});
  passed_.clear();
  dependencies_.statistics.swept(warned - pose.received, end - begin);
  reportFailures(report->failures);
  dependencies_.scene.swept(pose, report);
  if (dependencies_.monitor.counts(queued.checkpoint)) {  // otherwise time has jumped: nobody may move by these
    top_->run([&] { tool_.proximity.swept(pose, workpieces, *report, guard_); });
    top_->run([&] { tool_.interaction.swept(pose, workpieces, *report); });
    top_->run([&] { tool_.bodies.moved(pose); });
  }
  top_->run([&] { dependencies_.touches.swept(*report, workpieces); });
  forgetFrames();
}

// Against what is known further of frames, up to the newest pose. If it fails, the next sweep makes up for it.
void GuardThread::sweepOn() {
  const bool is_newest = swept_ && passed_.empty() && !placed_anew_.any;
  const bool waits = is_newest && frames_known_to_ < swept_->pose.stamp;
  if (!waits || !dependencies_.monitor.counts(checkpoint_)) return;
  frames_known_to_ = follow(swept_->pose);
  const auto report = reports_.take();
  const sweep_guard_core::Workpieces workpieces = dependencies_.workpieces.snapshot();
  beginSweep(*swept_, workpieces);
  try {
    guard_.sweepOn(workpieces, *report);
  } catch (...) {
    guard_.takeBack();
    throw;
  }
  warn(*report, *swept_);
  reportFailures(report->failures);
  dependencies_.scene.swept(swept_->pose, report);
  top_->run([&] { dependencies_.touches.swept(*report, workpieces); });
  forgetFrames();
}

void GuardThread::beginSweep(const sweep_guard_core::QueuedPose& queued,
                             const sweep_guard_core::Workpieces& workpieces) {
  const sweep_guard_core::PoseWithFrames& before = swept_ ? swept_->pose : queued.pose;
  dependencies_.sampler.setWorkpieces(
      workpieces, {/*measured=*/true, queued.checkpoint.epoch, stampedPoseOf(before), stampedPoseOf(queued.pose)});
  guard_.intend(dependencies_.intentions.at(std::chrono::steady_clock::now()));
}

void GuardThread::warn(const sweep_guard_core::SweepReport& report, const sweep_guard_core::QueuedPose& queued) {
  const SteadyTime swept = std::chrono::steady_clock::now();
  sweep_guard_core::beat();
  if (!report.objects.empty() || !report.replaced.empty()) results_.publish(report);
  sweep_guard_core::beat();
  dependencies_.monitor.swept(report, timestampsOf(queued.pose), queued.checkpoint, swept);
  dependencies_.warnings.publishIfChanged();
}

void GuardThread::reportFailures(const std::vector<sweep_guard_core::SweepFailure>& failures) {
  if (!dependencies_.monitor.counts(checkpoint_)) return;  // given up
  for (const sweep_guard_core::SweepFailure& failure : failures) {
    dependencies_.statistics.fault("'" + failure.workpiece->id + "': " + failure.reason);
    log_.error(failure.workpiece->id, "detection on '" + failure.workpiece->id + "' failed: " + failure.reason);
  }
}

bool GuardThread::mayPredict() const { return prediction_due_ && passed_.empty(); }

// Sweeps of queued poses go first, but delay the prediction by at most a cycle. It begins at a swept pose. One with other triangles
// does not wait for its turn: those from before stand in for them only for a while.
bool GuardThread::timeToPredict() const {
  if (!mayPredict()) return false;
  const SteadyTime at = std::chrono::steady_clock::now();
  if (at - predicted_at_ >= dependencies_.parameters.get()->guard.cycle) return true;
  return (triangles_are_new_ || at >= pace_.due()) && !dependencies_.queue.hasPoses();
}

// A prediction rather begins at the next pose, which is fresh, but waits for it no longer than this.
std::optional<SteadyTime> GuardThread::latestPrediction() const {
  if (!mayPredict()) return std::nullopt;
  return std::min(predicted_at_ + dependencies_.parameters.get()->guard.cycle, pace_.dueAfterNext());
}

void GuardThread::predict() {
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kPrediction);
  prediction_due_ = false;
  sweep_guard_core::beat();
  const Instant at = now();
  predicted_at_ = at.steady;
  predicted_from_ = *swept_;
  const auto& [pose, checkpoint] = predicted_from_;
  const Timestamps from = timestampsOf(pose);
  if (stale(from, at, dependencies_.parameters.get()->limits.pose_timeout)) return;
  sweep_guard_core::PredictionPace::Charge charge{pace_, at.steady};
  const Duration age = ageOf(from, at);
  const auto prediction = predictions_.take();
  const sweep_guard_core::Workpieces workpieces = dependencies_.workpieces.snapshot();
  predicted_with_ = workpieces;
  triangles_are_new_ = false;
  guard_.intend(dependencies_.intentions.at(at.steady));
  follow(predicted_from_.pose);
  predictInterrupted(age, workpieces, *prediction, charge.interrupted);
  const Duration took = std::chrono::steady_clock::now() - at.steady - charge.interrupted;
  dependencies_.monitor.predicted(*prediction, from, checkpoint, now(), took);
  dependencies_.warnings.publishIfChanged();
  sweep_guard_core::beat();
  if (!dependencies_.monitor.counts(checkpoint)) return;  // another epoch has begun meanwhile
  results_.publish(*prediction, age);

  const Duration considered = dependencies_.parameters.get()->limits.considered;
  dependencies_.statistics.predicted({std::chrono::steady_clock::now() - pose.received, took, prediction->sweeps_made,
                                      prediction->sweeps_asked, prediction->coveredUntil() - prediction->stamp - age,
                                      prediction->probability(PredictionInterval::kConsidered, age + considered)});
  reportFailures(prediction->failures);
  if (acknowledgements_.endWhereFar(workpieces, predictedFrom(pose, checkpoint_.epoch)))
    dependencies_.warnings.publishIfChanged();
  dependencies_.scene.predicted(pose, prediction);
  tool_.bodies.predicted(pose, *prediction);
}

// Sweeps the poses that come meanwhile, as long as none of them fails, and counts how long that takes.
void GuardThread::predictInterrupted(Duration age, const sweep_guard_core::Workpieces& workpieces,
                                     sweep_guard_core::Prediction& prediction, Duration& interrupted) {
  const auto origin = predictedFrom(predicted_from_.pose, predicted_from_.checkpoint.epoch);
  dependencies_.sampler.setWorkpieces(workpieces, origin);
  bool interruptible = true;
  sweep_guard_core::PredictionRun run = guard_.beginPrediction(age, workpieces, prediction);
  for (; !run.done(); run.step()) {
    if (!interruptible || (next_ == work_.poses.size() && !dependencies_.queue.hasPoses())) continue;
    const SteadyTime begin = std::chrono::steady_clock::now();
    top_->attempt([&] { interruptible = sweepWaiting(); });
    interrupted += std::chrono::steady_clock::now() - begin;
    dependencies_.sampler.setWorkpieces(workpieces, origin);
  }
}

PredictService::Motion GuardThread::motion(Duration horizon) const {
  const Instant at = now();
  const Timestamps from = timestampsOf(freshPose().pose);
  const Duration age = ageOf(from, at);
  sweep_guard_core::PredictedMotion motion = guard_.predictMotion(age, horizon);
  if (motion.path.empty()) throw Error("motion is not known yet: two tool poses in a row are needed");
  return {std::move(motion), age};
}

}  // namespace sweep_guard_ros
