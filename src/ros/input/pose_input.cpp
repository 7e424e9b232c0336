#include "ros/input/pose_input.h"

#include <boost/make_shared.hpp>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr size_t kMaxMessageSize = 16384;  // a frame name of any sense fits [bytes]
constexpr const char* kPassed = "positions of joints were dropped: others were silent meanwhile";
constexpr size_t kMaxJointsSize = 1U << 20U;  // [bytes]
constexpr char kPoseTopic[] = "tool_pose";
constexpr char kJointsTopic[] = "joint_states";
constexpr std::uint32_t kPosesQueued =
    65536;  // 65 s at 1 kHz; a pose that ROS drops beyond that is a gap in header.seq

struct PoseRefused : sweep_guard_core::InvalidInput {
  PoseRefused(Reason why, const std::string& message) : InvalidInput(message), reason(why) {}
  Reason reason;
};

void requireStamp(sweep_guard_core::Time stamp) {
  if (stamp == sweep_guard_core::Time())
    throw PoseRefused(sweep_guard_core::kPoseInvalid, "stamp is 0: stamp each pose");
  if (liesInFuture(stamp)) throw PoseRefused(sweep_guard_core::kFutureStamp, kFutureStampText);
}

std::string sourceOf(const ros::NodeHandle& node, const Parameters& parameters) {
  const std::string frames = "tf " + parameters.fixed_frame + " to " + parameters.tool_frame;
  const std::string joints = node.resolveName(kJointsTopic);
  if (parameters.tool_source == ToolSource::kJointStates) return joints + " on " + frames;
  const std::string pose = parameters.tool_source == ToolSource::kTf ? frames : node.resolveName(kPoseTopic);
  return parameters.articulated ? pose + " and " + joints : pose;
}

}  // namespace

template <typename Accept>
void PoseInput::refuseWhatFails(const Accept& accept) {
  try {
    accept();
  } catch (const PoseRefused& error) {
    refuse(error.reason, error.what());
  } catch (const FrameError& error) {
    refuse(sweep_guard_core::kTfFail, error.what());
  } catch (const sweep_guard_core::SeveralPublishers& error) {
    refuse(sweep_guard_core::kMultiPublisher, error.what());
  } catch (const sweep_guard_core::OutOfOrder& error) {
    refuse(sweep_guard_core::kOutOfOrder, error.what());
  } catch (const std::exception& error) {  // InvalidInput, or out of memory
    refuse(sweep_guard_core::kPoseInvalid, error.what());
  }
}

PoseInput::PoseInput(const ros::NodeHandle& node, const LiveParameters& live, const PoseInputDependencies& dependencies)
    : fixed_frame_(live.initial().fixed_frame),
      tool_frame_(live.initial().tool_frame),
      source_(sourceOf(node, live.initial())),
      allow_several_publishers_(live.initial().allow_several_publishers),
      live_(live),
      frames_(dependencies.frames),
      monitor_(dependencies.monitor),
      jumps_(live),
      moving_frames_(fixed_frame_, {frames_, dependencies.frame_motions, monitor_, dependencies.queue, record_}),
      late_(live, frames_),
      path_(fixed_frame_, {frames_, dependencies.workpieces, moving_frames_, monitor_, dependencies.queue}) {
  frames_moved_ = frames_.onMove([this] { onFramesMoved(); });
  if (live.initial().articulated) {
    articulated_ = std::make_unique<ArticulatedTool>(live);
    joints_ = subscribeBounded<sensor_msgs::JointState>(
        thread_.on(node), {kJointsTopic, kPosesQueued, kMaxJointsSize},
        [this](const auto& event) { refuseWhatFails([&] { acceptJoints(event); }); },
        [this](const std::string& reason) { refuse(sweep_guard_core::kPoseInvalid, reason); });
  }
  if (live.initial().tool_source == ToolSource::kTf) {
    transforms_changed_ = frames_.onChange([this] { onTransforms(); });
  } else if (live.initial().tool_source == ToolSource::kTopic) {
    subscriber_ = subscribeBounded<geometry_msgs::PoseStamped>(
        thread_.on(node), {kPoseTopic, kPosesQueued, kMaxMessageSize}, [this](const auto& event) { onMessage(event); },
        [this](const std::string& reason) { refuse(sweep_guard_core::kPoseInvalid, reason); });
  }
}

// Several nodes may publish joints, each its own.
std::optional<std::uint32_t> PoseInput::publishers() const {
  return subscriber_ ? std::optional(subscriber_.getNumPublishers()) : std::nullopt;
}

void PoseInput::onMessage(const ros::MessageEvent<const geometry_msgs::PoseStamped>& event) {
  const geometry_msgs::PoseStamped& msg = *event.getConstMessage();
  countLost(event.getPublisherName(), msg.header.seq);
  const sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  if (!articulated_) record_.received(timestamps);
  refuseWhatFails([&] { accept({timestamps, msg.header.frame_id, fromMsg(msg.pose)}, receipt()); });
}

void PoseInput::acceptJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event) {
  const sensor_msgs::JointState& msg = *event.getConstMessage();
  const sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  const Receipt now = receipt();
  begin(now);
  requireStamp(timestamps.stamp);
  if (live_.initial().tool_source == ToolSource::kJointStates) late_.use(tool_frame_);
  articulated_->add(event.getPublisherName(), msg);
  path_.note(timestamps.stamp, now.static_changes);
  pushKnownPoses(timestamps.received, checkpoint_);
  reportSilence(timestamps.stamp);
}

void PoseInput::reportSilence(sweep_guard_core::Time stamp) {
  const std::string silence = articulated_->silence(stamp);
  if (!silence.empty()) monitor_.fault(sweep_guard_core::kPoseStale, silence);
}

// Also of tool poses that came: the newest joint decides up to when all are known.
void PoseInput::pushKnownPoses(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint) {
  const auto root = [this](sweep_guard_core::Time stamp) { return late_.locateToolFrame(stamp); };
  while (articulated_->next(root, known_)) {
    if (articulated_->leavesOut()) monitor_.fault(sweep_guard_core::kPosesUnswept, kPassed);
    record_.received({known_.back().stamp, received});
    const std::string jump = jumpTo(known_.back());
    for (ArticulatedTool::Pose& pose : known_) pose.jump = jump;
    push(received, checkpoint);
  }
}

std::string PoseInput::jumpTo(const ArticulatedTool::Pose& state) {
  repeated_.add(state.X_WT, state.state.positions);
  std::string jump = jumps_.jumpTo(state);
  const std::string faster = jumps_.faster();
  if (!faster.empty()) record_.warn(faster);
  return jump;
}

// A publisher that does not count, or begins again, loses nothing.
void PoseInput::countLost(const std::string& publisher, std::uint32_t sequence) {
  const bool counts = publisher == publisher_ && sequence_ != 0 && sequence > sequence_ + 1;
  if (counts) {
    const std::uint32_t lost = sequence - sequence_ - 1;
    lost_ += lost;
    monitor_.posesLost(std::to_string(lost) + " tool poses were lost on the path", std::chrono::steady_clock::now());
  }
  if (publisher != publisher_) publisher_ = publisher;
  sequence_ = sequence;
}

bool PoseInput::hasSeveralPublishers() const {
  return subscriber_ && !allow_several_publishers_ && subscriber_.getNumPublishers() > 1;
}

void PoseInput::reportConflict() {
  const std::string conflict = allow_several_publishers_ ? "" : frames_.conflict();
  if (conflict.empty()) return;
  monitor_.fault(sweep_guard_core::kMultiPublisher, conflict);
  log_.error("conflict", conflict);
}

// Runs in the thread of the tf listener, or where static transforms are applied, one at a time.
void PoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // another transform has changed
  last_transform_ = newest;
  if (!newest) return;
  if (waiting_ >= kPosesQueued)
    return monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses from tf were dropped: too many wait");
  const sweep_guard_core::Timestamps timestamps{*newest, std::chrono::steady_clock::now()};
  const ReceivedPose pose{timestamps, tool_frame_, Eigen::Isometry3d::Identity()};
  ++waiting_;
  thread_.post([this, pose, now = receipt()] {
    --waiting_;
    if (!articulated_) record_.received(pose.timestamps);
    const bool outdated = now.checkpoint.epoch < checkpoint_.epoch;  // joints have come meanwhile
    refuseWhatFails([&] { accept(pose, outdated ? receipt() : now); });
  });
}

void PoseInput::refuse(Reason reason, const std::string& message) {
  record_.error(message, /*refused=*/true);
  monitor_.fault(reason, "tool pose refused: " + message);
  log_.error(std::to_string(reason), "tool pose on " + source_ + " refused: " + message);
}

PoseInput::Receipt PoseInput::receipt() const {
  const Checkpoint checkpoint = monitor_.checkpoint();
  return {checkpoint, frames_.staticChanges()};
}

// Of each input, before it is looked at.
void PoseInput::begin(const Receipt& receipt) {
  if (!receipt.checkpoint.continues(checkpoint_)) {
    pushWaiting();  // what can be
    late_.clear();
    path_.clear();
    if (articulated_) articulated_->reset();
    jumps_.reset();
  }
  checkpoint_ = receipt.checkpoint;
  // After the checkpoint: the sweep to this pose does not end the fault.
  if (hasSeveralPublishers()) {
    monitor_.fault(sweep_guard_core::kMultiPublisher, "several nodes publish tool poses on " + source_);
  }
  reportConflict();
}

void PoseInput::accept(ReceivedPose pose, const Receipt& receipt) {
  begin(receipt);
  const sweep_guard_core::Time stamp = pose.timestamps.stamp;
  requireStamp(stamp);
  const auto previous = late_.newest();
  if (previous && stamp < *previous) {
    throw PoseRefused(sweep_guard_core::kOutOfOrder, "stamp is older than the previous pose's");
  }
  late_.use(pose.frame);
  path_.note(stamp, receipt.static_changes);
  pose.checkpoint = checkpoint_;
  if (const auto located = late_.locate(pose)) return pushLocated(*located);
  pushWaiting();
  if (!late_.leaveOutIfFull()) return;
  monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses were left out: too many wait for the transform of '" +
                                                      sweep_guard_core::printable(pose.frame) + "'");
}

// A pose that is refused does not hold up those after it.
void PoseInput::pushWaiting() {
  bool more = true;
  const auto push_next = [&] {
    const auto located = late_.locateNext();
    more = located.has_value();
    if (located) pushLocated(*located);
  };
  while (more) refuseWhatFails(push_next);
}

void PoseInput::pushLocated(const LocatedPose& pose) {
  if (!articulated_) {
    known_.assign(1, {pose.stamp, pose.X_WT, {}, {}});
    known_.back().jump = jumpTo(known_.back());
    return push(pose.known, pose.checkpoint);
  }
  articulated_->add(pose.stamp, pose.X_WT);
  pushKnownPoses(pose.known, pose.checkpoint);
  reportSilence(pose.stamp);
}

// Runs in the thread of the tf listener.
void PoseInput::onFramesMoved() {
  moving_frames_.sample();
  if (!late_.hasBegunToWait()) return;
  thread_.post([this] { pushAllWaiting(); });
}

void PoseInput::pushAllWaiting() {
  pushWaiting();
  if (!articulated_ || !late_.jointsWait()) return;
  refuseWhatFails([this] { pushKnownPoses(std::chrono::steady_clock::now(), checkpoint_); });
}

void PoseInput::push(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint) {
  const auto changed_from = path_.push(known_, {received, checkpoint, late_.frame()});
  if (changed_from) path_.repeat(applyStaticChanges(*changed_from), checkpoint);
}

// Returns the frames that are followed and were placed anew, from this stamp on.
std::set<std::string> PoseInput::applyStaticChanges(sweep_guard_core::Time from) {
  std::set<std::string> anew;
  const auto apply = [&] { anew = moving_frames_.applyStaticChanges(from); };
  const auto X_WF = [this](sweep_guard_core::Time stamp) { return frames_.find(fixed_frame_, late_.frame(), stamp); };
  articulated_ ? articulated_->placeAnew(X_WF, apply) : apply();
  jumps_.reset();  // what is placed anew does not jump
  return anew;
}

// In the thread that places poses: none is placed half before, half after a change. Those that wait come first.
void PoseInput::applyLateChanges() {
  const auto late = [this] { return frames_.holdsBack(live_.get()->limits.pose_timeout); };
  if (!late()) return;
  thread_.post([this, late] {
    pushAllWaiting();
    if (!late_.empty() || !late()) return;
    const sweep_guard_core::Time changed_from = path_.endAtNewest(frames_.staticChanges());
    path_.repeat(applyStaticChanges(changed_from), checkpoint_);
  });
}

}  // namespace sweep_guard_ros
