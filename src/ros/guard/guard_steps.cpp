#include "ros/guard/guard_steps.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "common/heartbeat.h"
#include "ros/guard/detector_test.h"
#include "ros/input/future_stamp.h"
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

constexpr Duration kSilent = std::chrono::seconds(4);  // of a frame: others do not wait for it

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

GuardSteps::GuardSteps(const ros::NodeHandle& private_node, const GuardThreadDependencies& dependencies)
    : dependencies_(dependencies),
      results_(private_node, dependencies.parameters),
      proximity_(private_node, dependencies.parameters, dependencies.monitor),
      interaction_(private_node, dependencies.parameters, dependencies.monitor),
      bodies_(private_node, dependencies.parameters),
      guard_(guardOf(dependencies.parameters.initial(), firstDetector(dependencies))),
      acknowledgements_(dependencies.parameters, dependencies.monitor, dependencies.sampler, guard_) {}

void GuardSteps::setTool(const Parameters& parameters, ToolShapes& shapes) {
  proximity_.setTool(parameters);
  interaction_.exchange(shapes.pieces);
  bodies_.setTool(*parameters.bodies, shapes.surface);
}

GuardSteps::Taken GuardSteps::take(sweep_guard_core::QueuedPose& queued, const sweep_guard_core::QueuedPose* next) {
  if (!dependencies_.monitor.isToBeSwept(queued.checkpoint)) return Taken::kOutdated;
  if (!queued.checkpoint.continues(checkpoint_)) resetMotion();
  checkpoint_ = queued.checkpoint;
  takeCommands();
  const bool is_passed = queued.pose.anew || (next != nullptr && knowsAllFramesOf(queued, *next));
  frames_known_to_ = follow(queued.pose);
  if (!is_passed) return Taken::kToSweep;
  pass(queued.pose);
  return Taken::kPassed;
}

void GuardSteps::takeCommands() {
  if (dependencies_.commands == nullptr) return;
  dependencies_.commands->take(sent_);
  for (const sweep_guard_core::SentCommand& command : sent_) guard_.command(command);
}

// Returns the time up to which all frames that are followed are known, but for those that are silent: at most that of the pose.
sweep_guard_core::Time GuardSteps::follow(sweep_guard_core::PoseWithFrames& pose) {
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
void GuardSteps::forgetFrames() {
  if (dependencies_.frame_motions != nullptr) dependencies_.frame_motions->forgetBefore(swept_->pose.stamp, *frames_);
}

void GuardSteps::pass(const sweep_guard_core::PoseWithFrames& pose) {
  guard_.pass(pose);
  if (pose.anew) {
    placed_anew_.any = true;
    placed_anew_.frames.insert(pose.anew->frames.begin(), pose.anew->frames.end());
    if (pose.anew->tool) bodies_.reset();
    return interaction_.reset();
  }
  bodies_.moved(pose);
  passed_.push_back(pose.received);
  dependencies_.scene.passed(pose);
}

void GuardSteps::sweep(sweep_guard_core::QueuedPose& queued) {
  for (const std::string& frame : placed_anew_.frames) queued.pose.drifts.try_emplace(frame);
  try {
    const SteadyTime begin = std::chrono::steady_clock::now();
    const auto report = reports_.take();
    const sweep_guard_core::Workpieces workpieces = dependencies_.workpieces.snapshot();
    beginSweep(queued, workpieces);
    guard_.sweep(queued.pose, workpieces, *report);
    const SteadyTime end = std::chrono::steady_clock::now();
    triangles_are_new_ = !haveSameTriangles(workpieces, predicted_with_);
    swept_ = queued;
    warn(*report, queued);

    const SteadyTime warned = std::chrono::steady_clock::now();
    for (const SteadyTime received : passed_) dependencies_.statistics.swept(warned - received, {});
    passed_.clear();
    dependencies_.statistics.swept(warned - queued.pose.received, end - begin);
    publish(report, queued, workpieces);
  } catch (...) {
    guard_.takeBack();
    throw;
  }
  placed_anew_ = {};
  prediction_due_ = true;
}

void GuardSteps::publish(const std::shared_ptr<sweep_guard_core::SweepReport>& report,
                         const sweep_guard_core::QueuedPose& queued, const sweep_guard_core::Workpieces& workpieces) {
  const sweep_guard_core::PoseWithFrames& pose = queued.pose;
  reportFailures(report->failures);
  dependencies_.scene.swept(pose, report);
  if (dependencies_.monitor.counts(queued.checkpoint)) {  // otherwise time has jumped: nobody may move by these
    top_->run([&] { proximity_.swept(pose, workpieces, *report, guard_); });
    top_->run([&] { interaction_.swept(pose, workpieces, *report); });
    top_->run([&] { bodies_.moved(pose); });
  }
  top_->run([&] { dependencies_.touches.swept(*report, workpieces); });
  top_->run([&] { measureDistances(pose, workpieces); });
  forgetFrames();
}

void GuardSteps::measureDistances(const sweep_guard_core::PoseWithFrames& pose,
                                  const sweep_guard_core::Workpieces& workpieces) {
  if (dependencies_.distances == nullptr) return;
  measured_.clear();
  for (size_t i = 0; i < pose.bodies.size(); ++i) measured_.push_back(&guard_.tool(i));
  dependencies_.distances->add(pose, workpieces, std::chrono::steady_clock::now(), measured_);
}

// Returns whether the newest pose is swept, and still counts.
bool GuardSteps::sweptAll() const {
  return swept_ && passed_.empty() && !placed_anew_.any && dependencies_.monitor.counts(checkpoint_);
}

void GuardSteps::sweepOn() {
  if (sweptAll() && frames_known_to_ < swept_->pose.stamp) sweepAgain();
}

void GuardSteps::show(const std::shared_ptr<const sweep_guard_core::Workpiece>& image) {
  try {
    dependencies_.workpieces.show(image, now().stamp + kFutureTolerance);
  } catch (const sweep_guard_core::InvalidInput& error) {
    const std::string refusal = "camera '" + image->id + "' refused: " + error.what();
    dependencies_.monitor.meshRefused(image->id, refusal, image->received);
    return log_.error(image->id, refusal);
  }
  dependencies_.monitor.meshAccepted(image->id, image->received);
  if (sweptAll()) sweepAgain();
}

void GuardSteps::sweepAgain() {
  frames_known_to_ = follow(swept_->pose);
  const auto report = reports_.take();
  const sweep_guard_core::Workpieces workpieces = dependencies_.workpieces.snapshot();
  beginSweep(*swept_, workpieces);
  try {
    guard_.sweep(swept_->pose, workpieces, *report, /*arrived=*/false);
    warn(*report, *swept_);
  } catch (...) {
    guard_.takeBack();
    throw;
  }
  reportFailures(report->failures);
  dependencies_.scene.swept(swept_->pose, report);
  top_->run([&] { dependencies_.touches.swept(*report, workpieces); });
  forgetFrames();
}

void GuardSteps::beginSweep(const sweep_guard_core::QueuedPose& queued,
                            const sweep_guard_core::Workpieces& workpieces) {
  const sweep_guard_core::PoseWithFrames& before = swept_ ? swept_->pose : queued.pose;
  dependencies_.sampler.setWorkpieces(
      workpieces, {/*measured=*/true, queued.checkpoint.epoch, stampedPoseOf(before), stampedPoseOf(queued.pose)});
  guard_.intend(dependencies_.intentions.at(std::chrono::steady_clock::now()));
}

void GuardSteps::warn(const sweep_guard_core::SweepReport& report, const sweep_guard_core::QueuedPose& queued) {
  const SteadyTime swept = std::chrono::steady_clock::now();
  sweep_guard_core::beat();
  if (!report.objects.empty() || !report.replaced.empty()) results_.publish(report);
  sweep_guard_core::beat();
  dependencies_.monitor.swept(report, timestampsOf(queued.pose), queued.checkpoint, swept);
  dependencies_.warnings.publishIfChanged();
}

void GuardSteps::reportFailures(const std::vector<sweep_guard_core::SweepFailure>& failures) {
  if (!dependencies_.monitor.counts(checkpoint_)) return;  // given up
  for (const sweep_guard_core::SweepFailure& failure : failures) {
    dependencies_.statistics.fault("'" + failure.workpiece->id + "': " + failure.reason);
    log_.error(failure.workpiece->id, "detection on '" + failure.workpiece->id + "' failed: " + failure.reason);
  }
}

bool GuardSteps::choosePose(const Instant& now) {
  prediction_due_ = false;
  predicted_from_ = *swept_;
  return !stale(timestampsOf(predicted_from_.pose), now, dependencies_.parameters.get()->limits.pose_timeout);
}

RunningPrediction GuardSteps::beginPrediction(const Instant& now, sweep_guard_core::PredictionPace& pace) {
  predicted_with_ = dependencies_.workpieces.snapshot();
  triangles_are_new_ = false;
  guard_.intend(dependencies_.intentions.at(now.steady));
  follow(predicted_from_.pose);
  resumePrediction();
  const Duration age = ageOf(timestampsOf(predicted_from_.pose), now);
  const auto prediction = predictions_.take();
  return {now, age, prediction, {pace, now.steady}, guard_.beginPrediction(age, predicted_with_, *prediction)};
}

void GuardSteps::resumePrediction() {
  const auto& [pose, checkpoint] = predicted_from_;
  dependencies_.sampler.setWorkpieces(predicted_with_, predictedFrom(pose, checkpoint.epoch));
}

void GuardSteps::endPrediction(const RunningPrediction& running) {
  const auto& [pose, checkpoint] = predicted_from_;
  const sweep_guard_core::Prediction& prediction = *running.prediction;
  const Duration took = std::chrono::steady_clock::now() - running.begin.steady - running.charge.interrupted;
  dependencies_.monitor.predicted(prediction, timestampsOf(pose), checkpoint, now(), took);
  dependencies_.warnings.publishIfChanged();
  sweep_guard_core::beat();
  if (!dependencies_.monitor.counts(checkpoint)) return;  // another epoch has begun meanwhile
  results_.publish(prediction, running.age);

  const Duration considered = running.age + dependencies_.parameters.get()->limits.considered;
  dependencies_.statistics.predicted(
      {std::chrono::steady_clock::now() - pose.received, took, prediction.sweeps_made, prediction.sweeps_asked,
       prediction.coveredUntil() - prediction.stamp - running.age,
       prediction.probability(PredictionInterval::kConsidered, considered), prediction.source});
  reportFailures(prediction.failures);
  if (acknowledgements_.endWhereFar(predicted_with_, predictedFrom(pose, checkpoint_.epoch)))
    dependencies_.warnings.publishIfChanged();
  dependencies_.scene.predicted(pose, running.prediction);
  bodies_.predicted(pose, prediction);
}

std::string GuardSteps::acknowledge(const std::string& id) {
  const auto origin = predictedFrom(swept_.value_or(sweep_guard_core::QueuedPose()).pose, checkpoint_.epoch);
  return acknowledgements_.add(id, dependencies_.workpieces.snapshot(), origin);
}

void GuardSteps::forget() {
  dependencies_.monitor.restart();
  resetMotion();
  swept_.reset();
  prediction_due_ = false;
  dependencies_.scene.clear();
}

void GuardSteps::resetMotion() {
  guard_.reset();
  proximity_.reset();
  interaction_.reset();
  bodies_.reset();
  passed_.clear();
  placed_anew_ = {};
}

const sweep_guard_core::QueuedPose& GuardSteps::freshPose() const {
  if (const auto asked_by = dependencies_.monitor.disabledBy()) throw Error("the guard is disabled by " + *asked_by);
  if (!swept_ || !dependencies_.monitor.checkpoint().continues(checkpoint_)) throw Error("no tool pose yet");
  if (stale(timestampsOf(swept_->pose), now(), dependencies_.parameters.get()->limits.pose_timeout)) {
    throw Error("newest tool pose is stale: motion is unknown");
  }
  return *swept_;
}

PredictService::Motion GuardSteps::motion(Duration horizon) const {
  const Instant at = now();
  const Timestamps from = timestampsOf(freshPose().pose);
  const Duration age = ageOf(from, at);
  sweep_guard_core::PredictedMotion motion = guard_.predictMotion(age, horizon);
  if (motion.path.empty()) throw Error("motion is not known yet: two tool poses in a row are needed");
  return {std::move(motion), age};
}

}  // namespace sweep_guard_ros
