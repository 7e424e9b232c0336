#include "ros/input/pose_input.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "ros/input/pose_refusal.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr size_t kMaxMessageSize = 16384;  // a frame name of any sense fits [bytes]
constexpr const char* kTooMany = "tool poses were dropped: too many wait to be swept";
constexpr const char* kPassed = "positions of joints were dropped: others were silent meanwhile";
constexpr size_t kMaxJointsSize = 1U << 20U;  // [bytes]
constexpr char kPoseTopic[] = "tool_pose";
constexpr char kJointsTopic[] = "joint_states";
constexpr std::uint32_t kPosesQueued =
    65536;  // 65 s at 1 kHz; a pose that ROS drops beyond that is a gap in header.seq

std::string sourceOf(const ros::NodeHandle& node, const Parameters& parameters) {
  const std::string frames = "tf " + parameters.fixed_frame + " to " + parameters.tool_frame;
  const std::string joints = node.resolveName(kJointsTopic);
  if (parameters.tool_source == ToolSource::kJointStates) return joints + " on " + frames;
  const std::string pose = parameters.tool_source == ToolSource::kTf ? frames : node.resolveName(kPoseTopic);
  return parameters.articulated ? pose + " and " + joints : pose;
}

}  // namespace

PoseInput::PoseInput(const ros::NodeHandle& node, const LiveParameters& live, const PoseInputDependencies& dependencies)
    : fixed_frame_(live.initial().fixed_frame),
      tool_frame_(live.initial().tool_frame),
      source_(sourceOf(node, live.initial())),
      allow_several_publishers_(live.initial().allow_several_publishers),
      live_(live),
      frames_(dependencies.frames),
      monitor_(dependencies.monitor),
      queue_(dependencies.queue),
      recent_poses_(dependencies.recent_poses),
      resting_(live, frames_),
      watch_(live, record_),
      moving_frames_(fixed_frame_, {frames_, dependencies.frame_motions, monitor_, queue_, record_}),
      late_(live, frames_),
      path_(fixed_frame_, frames_, dependencies.workpieces, moving_frames_) {
  if (live.initial().tool_source != ToolSource::kTopic) late_.use(tool_frame_);  // before a pose, for what is refused
  frames_moved_ = frames_.onMove([this] { onFramesMoved(); });
  transforms_refused_ = frames_.onRefusal([this] { onRefusal(); });
  if (live.initial().articulated) {
    articulated_ = std::make_unique<ArticulatedTool>(live);
    joints_ = subscribeBounded<sensor_msgs::JointState>(
        thread_.on(node), {kJointsTopic, kPosesQueued, kMaxJointsSize},
        std::bind(&PoseInput::onJoints, this, std::placeholders::_1),
        [this](const std::string& reason) { refuse(sweep_guard_core::kPoseInvalid, reason); });
  }
  if (live.initial().tool_source == ToolSource::kTf) {
    transforms_changed_ = frames_.onChange([this] { onTransforms(); });
  } else if (live.initial().tool_source == ToolSource::kTopic) {
    subscriber_ = subscribeBounded<geometry_msgs::PoseStamped>(
        thread_.on(node), {kPoseTopic, kPosesQueued, kMaxMessageSize},
        std::bind(&PoseInput::onMessage, this, std::placeholders::_1),
        [this](const std::string& reason) { refuse(sweep_guard_core::kPoseInvalid, reason); });
  }
}

// Several nodes may publish joints, each its own.
std::optional<std::uint32_t> PoseInput::publishers() const {
  return subscriber_ ? std::optional(subscriber_.getNumPublishers()) : std::nullopt;
}

void PoseInput::onMessage(const ros::MessageEvent<const geometry_msgs::PoseStamped>& event) try {
  const geometry_msgs::PoseStamped& msg = *event.getConstMessage();
  countLost(event.getPublisherName(), msg.header.seq);
  const sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  if (!articulated_) record_.received(timestamps);
  accept({timestamps, msg.header.frame_id, fromMsg(msg.pose), monitor_.checkpoint(), frames_.staticChanges()});
} catch (...) {  // fromMsg()
  refuseCaught();
}

void PoseInput::onJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event) {
  const sensor_msgs::JointState& joints = *event.getConstMessage();
  const std::string* const named = articulated_->firstJointIn(joints);
  named == nullptr ? passOver(joints) : acceptJoints(joints, event.getPublisherName(), *named);
}

// Its stamp says nothing of the tool, whose newest positions may still be on the way.
void PoseInput::passOver(const sensor_msgs::JointState& joints) {
  articulated_->noteForeign(joints);
  reportSilence(now().stamp - live_.get()->limits.pose_timeout);
}

void PoseInput::acceptJoints(const sensor_msgs::JointState& joints, const std::string& sender,
                             const std::string& named) {
  sweep_guard_core::Timestamps timestamps{fromMsg(joints.header.stamp), std::chrono::steady_clock::now()};
  const Checkpoint checkpoint = monitor_.checkpoint();
  const std::uint64_t static_changes = frames_.staticChanges();
  begin(checkpoint);
  try {
    requireStamp(timestamps, named);
    articulated_->add(sender, joints, timestamps.received);
  } catch (...) {
    return refuseCaught("joint_states of " + sweep_guard_core::printable(sender) + ": ");
  }
  path_.note(timestamps.stamp, static_changes);
  pushKnownPoses(timestamps.received, checkpoint_);
  reportSilence(timestamps.stamp);
}

void PoseInput::reportSilence(sweep_guard_core::Time stamp) {
  const std::string silence = articulated_->silence(stamp);
  if (silence.empty()) return;
  record_.lacks(silence);
  monitor_.fault(sweep_guard_core::kPoseStale, silence);
}

// Also of tool poses that came: the newest joint decides up to when all are known.
void PoseInput::pushKnownPoses(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint) try {
  const auto root = [this](sweep_guard_core::Time stamp) { return late_.locateToolFrame(stamp); };
  while (articulated_->next(root, known_)) {
    if (articulated_->leavesOut()) monitor_.fault(sweep_guard_core::kPosesUnswept, kPassed);
    record_.received({known_.back().stamp, received});
    push(received, checkpoint);
  }
} catch (...) {
  refuseCaught();
}

void PoseInput::countLost(const std::string& publisher, std::uint32_t sequence) {
  const std::uint32_t lost = gaps_.add(publisher, sequence);
  if (lost == 0) return;
  lost_ += lost;
  monitor_.posesLost(std::to_string(lost) + " tool poses were lost on the path", std::chrono::steady_clock::now());
}

bool PoseInput::hasSeveralPublishers() const {
  return subscriber_ && !allow_several_publishers_ && subscriber_.getNumPublishers() > 1;
}

// Of a joint, also where several publishers are allowed: positions of one of them are refused.
void PoseInput::reportConflicts() {
  if (!allow_several_publishers_) reportConflict(frames_.conflict());
  if (articulated_) reportConflict(articulated_->conflict(std::chrono::steady_clock::now()));
}

void PoseInput::reportConflict(const std::string& conflict) {
  if (conflict.empty()) return;
  monitor_.fault(sweep_guard_core::kMultiPublisher, conflict);
  log_.error("conflict", conflict);
}

// A static transform comes once: what it would have moved is not known until a good one comes.
void PoseInput::reportRefusal() {
  const std::string refusal = frames_.refusal();
  if (!refusal.empty()) monitor_.fault(sweep_guard_core::kTfFail, refusal);
}

// Runs in the thread of the tf listener.
void PoseInput::onRefusal() {
  const std::string of_tool = frames_.refusalFor("tool");
  const std::string refusal = of_tool.empty() ? frames_.refusal() : of_tool;
  record_.error(refusal, /*refused=*/!of_tool.empty());
  monitor_.fault(sweep_guard_core::kTfFail, refusal);
}

// Runs in the thread of the tf listener, or where static transforms are applied, one at a time.
void PoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // another transform has changed
  last_transform_ = newest;
  if (newest && resting_.moves(*newest)) addPoseOfFrame(*newest, /*rests=*/false);
}

void PoseInput::addPoseOfFrame(sweep_guard_core::Time stamp, bool rests) {
  if (waiting_ >= kPosesQueued)
    return monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses from tf were dropped: too many wait");
  const Checkpoint checkpoint = monitor_.checkpoint();
  ReceivedPose pose{{stamp, {}}, tool_frame_, Eigen::Isometry3d::Identity(), checkpoint, frames_.staticChanges()};
  ++waiting_;
  thread_.post([this, pose, rests]() mutable {
    --waiting_;
    pose.timestamps.received = std::chrono::steady_clock::now();
    if (!articulated_) record_.received(pose.timestamps);
    if (pose.checkpoint.epoch < checkpoint_.epoch) {  // joints have come meanwhile
      pose.checkpoint = monitor_.checkpoint();
      pose.static_changes = frames_.staticChanges();
    }
    accept(pose, rests);
    if (rests) rested_until_ = pose.timestamps.stamp;
  });
}

// A lookup may wait for the listener: not in the thread that calls.
void PoseInput::addRestingPose() {
  if (live_.initial().tool_source != ToolSource::kTf || waiting_ > 0 || !resting_.isDue(now())) return;
  ++waiting_;
  thread_.post([this] {
    --waiting_;
    try {
      const sweep_guard_core::Time stamp = now().stamp;
      if (resting_.rests(stamp)) addPoseOfFrame(stamp, /*rests=*/true);
    } catch (...) {
      refuseCaught();
    }
  });
}

// Refuses an input for the exception that is being handled.
// @param sender  in words, at the beginning of the message
void PoseInput::refuseCaught(const std::string& sender) {
  const auto [reason, message] = caughtRefusal();
  refuse(reason, sender + message);
}

void PoseInput::refuse(Reason reason, const std::string& message) {
  record_.error(message, /*refused=*/true);
  monitor_.fault(reason, "tool pose refused: " + message);
  log_.error(std::to_string(reason), "tool pose on " + source_ + " refused: " + message);
}

// Of each input, before it is looked at.
void PoseInput::begin(const Checkpoint& checkpoint) {
  if (!checkpoint.continues(checkpoint_)) {
    pushWaiting();  // what can be
    late_.clear();
    path_.clear();
    if (articulated_) articulated_->reset();
    watch_.reset();
    rested_until_ = {};
  }
  checkpoint_ = checkpoint;
  // After the checkpoint: the sweep to this pose does not end the fault.
  if (hasSeveralPublishers()) {
    monitor_.fault(sweep_guard_core::kMultiPublisher, "several nodes publish tool poses on " + source_);
  }
  reportConflicts();
  reportRefusal();
}

// Where a tool from tf ceases to rest, its first transforms may be older than its newest pose at rest, and the other way round.
void PoseInput::accept(ReceivedPose pose, bool rests) try {
  begin(pose.checkpoint);
  const auto previous = late_.newest();
  const sweep_guard_core::Time rested_until = rests ? previous.value_or(rested_until_) : rested_until_;
  const sweep_guard_core::Time stamp = std::max(pose.timestamps.stamp, rested_until);
  pose.timestamps.stamp = stamp;
  requireStamp(pose.timestamps);
  if (previous) requireOrder(stamp, *previous);
  late_.use(pose.frame);
  path_.note(stamp, pose.static_changes);
  if (const auto located = late_.locate(pose)) return pushLocated(*located);
  pushWaiting();
  if (!late_.leaveOutIfFull()) return;
  monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses were left out: too many wait for the transform of '" +
                                                      sweep_guard_core::printable(pose.frame) + "'");
} catch (...) {
  refuseCaught();
}

// A pose that is refused does not hold up those after it.
void PoseInput::pushWaiting() {
  for (bool more = true; more;) {
    try {
      const auto located = late_.locateNext();
      more = located.has_value();
      if (located) pushLocated(*located);
    } catch (...) {
      refuseCaught();
    }
  }
}

void PoseInput::pushLocated(const sweep_guard_core::QueuedPose& located) {
  const auto& [pose, checkpoint] = located;
  if (!articulated_) {
    known_.assign(1, pose);
    return push(pose.received, checkpoint);
  }
  articulated_->add(pose.stamp, pose.X_WT);
  pushKnownPoses(pose.received, checkpoint);
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
  if (articulated_ && late_.jointsWait()) pushKnownPoses(std::chrono::steady_clock::now(), checkpoint_);
}

void PoseInput::push(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint) {
  const std::string jump = watch_.add(known_.back());  // the others are those that the motion to it was cut into
  for (sweep_guard_core::PoseWithFrames& pose : known_) {
    pose.received = received;
    pose.jump = jump;
    recent_poses_.add(pose.stamp, pose.bodies);
  }
  const auto changed_from = path_.place(known_, late_.frame(), checkpoint, placed_);
  for (sweep_guard_core::QueuedPose& pose : placed_) {
    if (!queue_.push(std::move(pose))) monitor_.fault(sweep_guard_core::kPosesUnswept, kTooMany);
  }
  if (changed_from) repeat(*changed_from, checkpoint);
}

// Queues the path since a change of static transforms where they say, from this stamp on.
void PoseInput::repeat(sweep_guard_core::Time changed_from, const Checkpoint& checkpoint) {
  path_.repeat(applyStaticChanges(changed_from), checkpoint, placed_);
  for (sweep_guard_core::QueuedPose& pose : placed_) {
    if (!queue_.push(std::move(pose))) monitor_.fault(sweep_guard_core::kPosesUnswept, kTooMany);
  }
}

// Returns the frames that are followed and were placed anew, from this stamp on.
std::set<std::string> PoseInput::applyStaticChanges(sweep_guard_core::Time from) {
  std::set<std::string> anew;
  const auto apply = [&] { anew = moving_frames_.applyStaticChanges(from); };
  const auto X_WF = [this](sweep_guard_core::Time stamp) { return frames_.find(fixed_frame_, late_.frame(), stamp); };
  articulated_ ? articulated_->placeAnew(X_WF, apply) : apply();
  watch_.reset();
  return anew;
}

// In the thread that places poses: none is placed half before, half after a change. Those that wait come first.
void PoseInput::applyLateChanges() {
  const auto late = [this] { return frames_.holdsBack(live_.get()->limits.pose_timeout); };
  if (!late()) return;
  thread_.post([this, late] {
    pushAllWaiting();
    if (!late_.empty() || !late()) return;
    repeat(path_.endAtNewest(frames_.staticChanges()), checkpoint_);
  });
}

}  // namespace sweep_guard_ros
