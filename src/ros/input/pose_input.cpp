#include "ros/input/pose_input.h"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr size_t kMaxWaitingPoses = 8192;  // poses
constexpr size_t kMaxToolFrames = 16;      // made-up names take no room from others
constexpr size_t kMaxMessageSize = 16384;  // a frame name of any sense fits [bytes]
constexpr const char* kPassed = "positions of joints were dropped: others were silent meanwhile";
constexpr size_t kMaxJointsSize = 1U << 20U;                                       // [bytes]
constexpr sweep_guard_core::Duration kBeforeChange = std::chrono::nanoseconds(1);  // of place, a pose was where it was
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

// Moves the tool with all that belongs to it by a motion of the fixed frame.
void moveTool(const Eigen::Isometry3d& motion_W, sweep_guard_core::PoseWithFrames& pose) {
  pose.X_WT = motion_W * pose.X_WT;
  for (sweep_guard_core::BodyPose& body : pose.bodies) body.X_WB = motion_W * body.X_WB;
  pose.state.X_WR = motion_W * pose.state.X_WR;
}

std::optional<Eigen::Isometry3d> poseIfKnown(const Frames& frames, const std::string& target, const std::string& source,
                                             sweep_guard_core::Time stamp) {
  try {
    return frames.lookup(target, source, stamp);
  } catch (const FrameError&) {
    return std::nullopt;
  }
}

std::set<std::string> movedFrames(const MovingFrames::Poses& before, const MovingFrames::Poses& now) {
  std::set<std::string> moved;
  for (const auto& [frame, X_WM] : now) {
    const auto known = before.find(frame);
    if (known != before.end() && known->second.matrix() != X_WM.matrix()) moved.insert(frame);
  }
  return moved;
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
      workpieces_(dependencies.workpieces),
      monitor_(dependencies.monitor),
      queue_(dependencies.queue),
      jumps_(live),
      moving_frames_(fixed_frame_, {frames_, dependencies.frame_motions, monitor_, queue_, record_}) {
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
  if (live_.initial().tool_source == ToolSource::kJointStates) useToolFrame(tool_frame_);
  articulated_->add(event.getPublisherName(), msg);
  noteStamp(timestamps.stamp, now);
  pushKnownPoses(timestamps.received, checkpoint_);
  const std::string silence = articulated_->silence(timestamps.stamp);
  if (!silence.empty()) monitor_.fault(sweep_guard_core::kPoseStale, silence);
}

// Also of tool poses that came: the newest joint decides up to when all are known.
void PoseInput::pushKnownPoses(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint) {
  const auto root = [this](sweep_guard_core::Time stamp) { return placeRoot(stamp); };
  while (articulated_->next(root, known_)) {
    if (articulated_->leavesOut()) monitor_.fault(sweep_guard_core::kPosesUnswept, kPassed);
    record_.received({known_.back().stamp, received});
    const std::string jump = jumpTo(known_.back());
    for (ArticulatedTool::Pose& pose : known_) pose.jump = jump;
    push(known_, received, checkpoint);
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
    placeWaiting();  // what can be
    previous_stamp_.reset();
    waiting_poses_.clear();
    root_waits_since_.reset();
    placed_.X_WF.reset();
    newest_stamp_.reset();
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

// Of each input that is accepted. Nobody knows when static transforms changed: after what had come in before.
void PoseInput::noteStamp(sweep_guard_core::Time stamp, const Receipt& receipt) {
  if (receipt.static_changes > static_changes_ && !changed_after_)
    changed_after_ = newest_stamp_.value_or(sweep_guard_core::Time());
  static_changes_ = std::max(static_changes_, receipt.static_changes);
  newest_stamp_ = std::max(newest_stamp_.value_or(stamp), stamp);
}

void PoseInput::accept(const ReceivedPose& pose, const Receipt& receipt) {
  begin(receipt);
  const sweep_guard_core::Time stamp = pose.timestamps.stamp;
  requireStamp(stamp);
  const auto previous = waiting_poses_.empty() ? previous_stamp_ : waiting_poses_.back().pose.timestamps.stamp;
  if (previous && stamp < *previous) {
    throw PoseRefused(sweep_guard_core::kOutOfOrder, "stamp is older than the previous pose's");
  }
  useToolFrame(pose.frame);
  noteStamp(stamp, receipt);
  const WaitingPose next{pose, checkpoint_};
  if (waiting_poses_.empty() && place(next, pose.timestamps.received)) return;
  waiting_poses_.push_back(next);
  placeWaiting();
  if (waiting_poses_.size() <= kMaxWaitingPoses) return;
  waiting_poses_.erase(waiting_poses_.begin() + 1);
  monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses were left out: too many wait for the transform of '" +
                                                      sweep_guard_core::printable(pose.frame) + "'");
}

void PoseInput::placeWaiting() {
  bool more = true;
  while (more && !waiting_poses_.empty()) refuseWhatFails([&] { more = placeNext(); });
}

// In their order: those after a pose that waits for its transform wait, too. Returns false if the first still waits. For the guard,
// they are received with their transforms.
bool PoseInput::placeNext() {
  const WaitingPose next = waiting_poses_.front();
  waiting_poses_.pop_front();
  if (place(next, std::chrono::steady_clock::now())) return true;
  waiting_poses_.push_front(next);
  return false;
}

// Returns false while its transform may still come.
bool PoseInput::place(const WaitingPose& waiting, sweep_guard_core::SteadyTime known) {
  const sweep_guard_core::Time stamp = waiting.pose.timestamps.stamp;
  const auto X_WF = place(waiting.pose.frame, stamp, waiting.pose.timestamps.received);
  if (!X_WF) return false;
  previous_stamp_ = stamp;
  tool_given_in_ = waiting.pose.frame;
  const Eigen::Isometry3d X_WT = *X_WF * waiting.pose.X_FT;
  if (!articulated_) {
    known_.assign(1, {stamp, X_WT, {}, {}});
    known_.back().jump = jumpTo(known_.back());
    push(known_, known, waiting.checkpoint);
    return true;
  }
  articulated_->add(stamp, X_WT);
  pushKnownPoses(known, waiting.checkpoint);
  const std::string silence = articulated_->silence(stamp);
  if (!silence.empty()) monitor_.fault(sweep_guard_core::kPoseStale, silence);
  return true;
}

// Returns nothing while the transform may still come. It may have come after the first look, and nobody tells of it again.
std::optional<Eigen::Isometry3d> PoseInput::place(const std::string& frame, sweep_guard_core::Time stamp,
                                                  sweep_guard_core::SteadyTime received) {
  for (const bool waits : {false, true}) {
    waits_ = waits_ || waits;
    try {
      return frames_.lookup(fixed_frame_, frame, stamp);
    } catch (const FrameError& error) {
      const auto newest = frames_.newest(fixed_frame_, frame);
      if (!newest || *newest >= stamp) throw;
      if (std::chrono::steady_clock::now() - received > live_.get()->limits.pose_timeout)
        throw FrameError(std::string(error.what()) + ": it has not come within timing/pose_timeout");
    }
  }
  return std::nullopt;
}

// Of a state of the joints, whose time to wait begins when it is asked for first.
std::optional<Eigen::Isometry3d> PoseInput::placeRoot(sweep_guard_core::Time stamp) {
  const sweep_guard_core::SteadyTime since = root_waits_since_.value_or(std::chrono::steady_clock::now());
  root_waits_since_.reset();
  auto X_WT = place(tool_frame_, stamp, since);
  if (!X_WT) root_waits_since_ = since;
  if (X_WT) tool_given_in_ = tool_frame_;
  return X_WT;
}

// Runs in the thread of the tf listener.
void PoseInput::onFramesMoved() {
  moving_frames_.sample();
  if (!waits_.exchange(false)) return;
  thread_.post([this] { placeAllWaiting(); });
}

void PoseInput::placeAllWaiting() {
  placeWaiting();
  if (!articulated_ || !root_waits_since_) return;
  refuseWhatFails([this] { pushKnownPoses(std::chrono::steady_clock::now(), checkpoint_); });
}

// Before what is placed by them: from then on, their changes are told.
void PoseInput::useToolFrame(const std::string& frame) {
  if (tool_frames_.count(frame) != 0) return;
  if (tool_frames_.size() == kMaxToolFrames) tool_frames_.clear();
  tool_frames_.insert(frame);
  frames_.use("tool", fixed_frame_, tool_frames_);
}

void PoseInput::useWorkpieceFrames() {
  const auto frames = workpieces_.frames();
  if (frames == workpiece_frames_) return;
  workpiece_frames_ = frames;
  frames_.use("workpieces", fixed_frame_, *frames);
}

// The path to the first pose after static transforms changed is swept where things were, then where they are. The transforms are
// applied between the two; several changes count as one.
void PoseInput::push(std::vector<ArticulatedTool::Pose>& poses, sweep_guard_core::SteadyTime received,
                     const Checkpoint& checkpoint) {
  useWorkpieceFrames();
  const sweep_guard_core::Time stamp = poses.back().stamp;
  const bool changed = changed_after_ && *changed_after_ < stamp;
  const bool twice = changed && placed_.X_WF;
  const Checkpoint before = placed_.checkpoint;
  path_.clear();
  if (twice) path_.push_back(placed_);
  for (ArticulatedTool::Pose& pose : poses) {
    sweep_guard_core::PoseWithFrames placed = place(pose, received, checkpoint);
    if (changed) path_.push_back(placed_);
    if (twice) placed.stamp = std::min(placed.stamp, stamp - kBeforeChange);
    if (!changed || twice) push(std::move(placed), twice ? before : checkpoint);
  }
  if (changed) pushPathAnew(stamp, twice ? path_.size() - 1 : 0, checkpoint);
}

sweep_guard_core::PoseWithFrames PoseInput::place(ArticulatedTool::Pose& pose, sweep_guard_core::SteadyTime received,
                                                  const Checkpoint& checkpoint) {
  auto& [stamp, X_WT, bodies, state, jump] = pose;
  if (placed_.X_WF) stamp = std::max(stamp, placed_.pose.stamp);  // after a change that was applied late
  sweep_guard_core::PoseWithFrames placed{stamp, received, X_WT, {}, std::move(bodies), std::move(state)};
  placed.jump = std::move(jump);
  placed.X_WM = moving_frames_.locate(*workpiece_frames_, stamp);
  placed_.X_WF = poseIfKnown(frames_, fixed_frame_, tool_given_in_, stamp);
  placed_.frame = tool_given_in_;
  placed_.checkpoint = checkpoint;
  placed_.pose = placed;
  return placed;
}

void PoseInput::push(sweep_guard_core::PoseWithFrames pose, const Checkpoint& checkpoint) {
  if (queue_.push({std::move(pose), checkpoint})) return;
  monitor_.fault(sweep_guard_core::kPosesUnswept, "tool poses were dropped: too many wait to be swept");
}

// What is placed anew does not move on the path, but for the tool.
// @param stamp  at which the path is repeated
// @param anew   of its poses, so many did not move to where they are
void PoseInput::pushPathAnew(sweep_guard_core::Time stamp, size_t anew, const Checkpoint& checkpoint) {
  sweep_guard_core::PlacedAnew placed_anew;
  placed_anew.frames = applyStaticChanges(stamp);
  placed_anew.tool = movePath();
  const MovingFrames::Poses X_WM = moving_frames_.resting(*workpiece_frames_);
  placed_anew.frames.merge(movedFrames(path_.front().pose.X_WM, X_WM));
  const sweep_guard_core::SteadyTime received = path_.back().pose.received;
  for (size_t i = 0; i < path_.size(); ++i) {
    sweep_guard_core::PoseWithFrames& pose = path_[i].pose;
    if (anew > 0) pose.stamp = stamp;
    pose.received = received;
    pose.X_WM = X_WM;
    pose.jump.clear();
    if (i < anew) pose.anew = placed_anew;
    placed_anew.goes_on = true;
    push(pose, checkpoint);
  }
  placed_ = path_.back();
  placed_.pose.anew.reset();
  placed_.X_WF = poseIfKnown(frames_, fixed_frame_, placed_.frame, stamp);
}

// Returns the frames that are followed and were placed anew, from this stamp on.
std::set<std::string> PoseInput::applyStaticChanges(sweep_guard_core::Time from) {
  changed_after_.reset();
  std::set<std::string> anew;
  const auto apply = [&] { anew = moving_frames_.applyStaticChanges(from); };
  const auto X_WF = [this](sweep_guard_core::Time stamp) {
    return poseIfKnown(frames_, fixed_frame_, tool_given_in_, stamp);
  };
  articulated_ ? articulated_->placeAnew(X_WF, apply) : apply();
  jumps_.reset();  // what is placed anew does not jump
  return anew;
}

// Returns whether the tool is elsewhere on the path. A pose that tf has forgotten moves as the one after it.
bool PoseInput::movePath() {
  bool moved = false;
  Eigen::Isometry3d motion_W = Eigen::Isometry3d::Identity();
  for (auto placed = path_.rbegin(); placed != path_.rend(); ++placed) {
    const auto X_WF = poseIfKnown(frames_, fixed_frame_, placed->frame, placed->pose.stamp);
    if (X_WF && placed->X_WF) {
      const bool rests = X_WF->matrix() == placed->X_WF->matrix();
      motion_W = rests ? Eigen::Isometry3d::Identity() : *X_WF * placed->X_WF->inverse();
      moved = moved || !rests;
    }
    moveTool(motion_W, placed->pose);
    if (placed->X_WF) placed->X_WF = motion_W * *placed->X_WF;
  }
  return moved;
}

// In the thread that places poses: none is placed half before, half after a change. Those that wait come first.
void PoseInput::applyLateChanges() {
  const auto late = [this] { return frames_.holdsBack(live_.get()->limits.pose_timeout); };
  if (!late()) return;
  thread_.post([this, late] {
    placeAllWaiting();
    if (!waiting_poses_.empty() || root_waits_since_ || !late()) return;
    static_changes_ = frames_.staticChanges();
    if (!placed_.X_WF) return static_cast<void>(applyStaticChanges(newest_stamp_.value_or(sweep_guard_core::Time())));
    path_.assign(1, placed_);
    path_.back().pose.received = std::chrono::steady_clock::now();
    pushPathAnew(placed_.pose.stamp + kBeforeChange, 1, checkpoint_);
  });
}

}  // namespace sweep_guard_ros
