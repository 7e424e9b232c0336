#include "ros/input/pose_input.h"

#include <boost/make_shared.hpp>

#include "common/heartbeat.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr auto kPoseTransformWait = std::chrono::milliseconds(20);
constexpr auto kPauseOfWaits = std::chrono::milliseconds(200);
constexpr size_t kMaxMissing = 1000;       // as many as workpieces
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
      tool_in_tf_(live.initial().tool_source != ToolSource::kTopic),
      frames_(dependencies.frames),
      workpieces_(dependencies.workpieces),
      monitor_(dependencies.monitor),
      queue_(dependencies.queue),
      frame_motions_(dependencies.frame_motions),
      jumps_(live) {
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
  refuseWhatFails([&] { accept({timestamps, msg.header.frame_id, fromMsg(msg.pose)}); });
}

void PoseInput::acceptJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event) {
  const sensor_msgs::JointState& msg = *event.getConstMessage();
  const sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  begin();
  requireStamp(timestamps.stamp);
  articulated_->add(event.getPublisherName(), msg);
  pushKnownPoses(timestamps.received);
  const std::string silence = articulated_->silence(timestamps.stamp);
  if (!silence.empty()) monitor_.fault(sweep_guard_core::kPoseStale, silence);
}

// Also of tool poses that came: the newest joint decides up to when all are known.
void PoseInput::pushKnownPoses(sweep_guard_core::SteadyTime received) {
  const auto frame = [this](sweep_guard_core::Time stamp) { return lookup(fixed_frame_, tool_frame_, stamp); };
  while (articulated_->next(frame, known_)) {
    if (articulated_->leavesOut()) monitor_.fault(sweep_guard_core::kPosesUnswept, kPassed);
    record_.received({known_.back().stamp, received});
    const std::string jump = jumpTo(known_.back());
    for (ArticulatedTool::Pose& pose : known_) {
      pose.jump = jump;
      push(received, std::move(pose));
    }
  }
}

std::string PoseInput::jumpTo(const ArticulatedTool::Pose& state) {
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
    monitor_.posesLost(std::to_string(lost) + " tool poses were lost on the way", std::chrono::steady_clock::now());
  }
  if (publisher != publisher_) publisher_ = publisher;
  sequence_ = sequence;
}

bool PoseInput::hasSeveralPublishers() const {
  return subscriber_ && !allow_several_publishers_ && subscriber_.getNumPublishers() > 1;
}

// Of the frames that place the tool or a workpiece.
void PoseInput::reportConflict() {
  if (allow_several_publishers_ || !frames_.hasConflicts()) return;
  std::set<std::string> placed = *workpieces_.frames();
  placed.insert(tool_in_tf_ ? tool_frame_ : pose_frame_);
  const std::string conflict = frames_.conflict(fixed_frame_, placed);
  if (conflict.empty()) return;
  monitor_.fault(sweep_guard_core::kMultiPublisher, conflict);
  log_.error("conflict", conflict);
}

// Runs in the thread of the tf listener, which must not wait for transforms: only reads the pose.
void PoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // another transform has changed
  last_transform_ = newest;
  if (!newest) return;
  try {
    if (waiting_ >= kPosesQueued) {
      return monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses from tf were dropped: too many wait");
    }
    const ReceivedPose pose{
        {*newest, std::chrono::steady_clock::now()}, fixed_frame_, frames_.lookup(fixed_frame_, tool_frame_, *newest)};
    ++waiting_;
    thread_.post([this, pose] {
      --waiting_;
      if (!articulated_) record_.received(pose.timestamps);
      refuseWhatFails([&] { accept(pose); });
    });
  } catch (const FrameError& error) {
    record_.error(error.what(), /*refused=*/false);
    monitor_.fault(sweep_guard_core::kTfFail, error.what());
  }
}

void PoseInput::refuse(Reason reason, const std::string& message) {
  record_.error(message, /*refused=*/true);
  monitor_.fault(reason, "tool pose refused: " + message);
  log_.error(std::to_string(reason), "tool pose on " + source_ + " refused: " + message);
}

// Of each input, before it is looked at.
void PoseInput::begin() {
  const sweep_guard_core::WarningMonitor::Checkpoint checkpoint = monitor_.checkpoint();
  waited_ = false;
  if (!checkpoint.continues(checkpoint_)) {
    previous_stamp_.reset();
    if (articulated_) articulated_->reset();
    jumps_.reset();
  }
  checkpoint_ = checkpoint;
  // After the checkpoint: the sweep to this pose does not end the fault.
  if (hasSeveralPublishers()) {
    monitor_.fault(sweep_guard_core::kMultiPublisher, "several nodes publish tool poses on " + source_);
  }
  reportConflict();
}

void PoseInput::accept(const ReceivedPose& pose) {
  pose_frame_ = pose.frame;
  begin();
  const auto& [stamp, received] = pose.timestamps;
  requireStamp(stamp);
  if (previous_stamp_ && stamp < *previous_stamp_) {
    throw PoseRefused(sweep_guard_core::kOutOfOrder, "stamp is older than the previous pose's");
  }
  const Eigen::Isometry3d X_WT = lookup(fixed_frame_, pose.frame, stamp) * pose.X_FT;
  previous_stamp_ = stamp;
  if (!articulated_) {
    ArticulatedTool::Pose known{stamp, X_WT, {}, {}};
    known.jump = jumpTo(known);
    return push(received, std::move(known));
  }
  articulated_->add(stamp, X_WT);
  pushKnownPoses(received);
  const std::string silence = articulated_->silence(stamp);
  if (!silence.empty()) monitor_.fault(sweep_guard_core::kPoseStale, silence);
}

void PoseInput::push(sweep_guard_core::SteadyTime received, ArticulatedTool::Pose pose) {
  auto& [stamp, X_WT, bodies, state, jump] = pose;
  auto frames = locate(*workpieces_.frames(), stamp);
  if (queue_.push({{stamp, received, X_WT, std::move(frames), std::move(bodies), std::move(state), std::move(jump)},
                   checkpoint_}))
    return;
  monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses were dropped: too many wait to be swept");
}

std::map<std::string, Eigen::Isometry3d> PoseInput::locate(const std::set<std::string>& mesh_frames,
                                                           sweep_guard_core::Time stamp) {
  std::map<std::string, Eigen::Isometry3d> X_WM;
  for (const std::string& frame : mesh_frames) {
    sweep_guard_core::beat();
    if (frame_motions_ != nullptr && frame_motions_->expects(frame)) {
      if (const auto known = frame_motions_->at(frame, stamp)) X_WM[frame] = *known;
      continue;
    }
    try {
      X_WM[frame] = lookup(fixed_frame_, frame, stamp);
    } catch (const FrameError& error) {
      const std::string message = "workpieces in '" + frame + "' not swept: " + error.what();
      record_.error(message, /*refused=*/false);
      monitor_.fault(sweep_guard_core::kTfFail, error.what());
      log_.error(frame, message);
    }
  }
  return X_WM;
}

Eigen::Isometry3d PoseInput::lookup(const std::string& target, const std::string& source,
                                    sweep_guard_core::Time stamp) {
  try {
    return frames_.lookup(target, source, stamp);
  } catch (const FrameError&) {
    return waitFor(target, source, stamp);
  }
}

// Waits for a late transform, but not again while its publisher is silent, once for each pose, and seldom for frames that
// tf does not know: waiting would delay every pose.
Eigen::Isometry3d PoseInput::waitFor(const std::string& target, const std::string& source,
                                     sweep_guard_core::Time stamp) {
  const std::pair frames(target, source);
  const auto newest = frames_.newest(target, source);
  const auto missed = missing_.find(frames);
  const bool silent = missed != missing_.end() && missed->second == newest;
  const sweep_guard_core::SteadyTime begin = std::chrono::steady_clock::now();
  const bool waits = !silent && !waited_ && (newest || begin >= no_wait_until_);
  try {
    return frames_.lookup(target, source, stamp, waits ? kPoseTransformWait : sweep_guard_core::Duration(0));
  } catch (const FrameError&) {
    waited_ = waited_ || waits;
    if (waits && !newest) no_wait_until_ = begin + kPauseOfWaits;
    if (missing_.size() >= kMaxMissing) missing_.clear();
    if (newest) missing_[frames] = frames_.newest(target, source);
    throw;
  }
}

}  // namespace sweep_guard_ros
