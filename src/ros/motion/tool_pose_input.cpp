#include "ros/motion/tool_pose_input.h"

#include "common/frame_name.h"
#include "ros/input/future_stamp.h"
#include "ros/motion/command_frames.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;

constexpr std::uint32_t kPosesQueued = 1;  // only the newest counts
constexpr size_t kMaxPoseSize = 16384;
constexpr sweep_guard_core::Duration kInstant{1};

Eigen::Isometry3d nearestInTime(const Frames& frames, const std::string& target, const std::string& source,
                                sweep_guard_core::Time stamp) {
  try {
    return frames.lookup(target, source, stamp);
  } catch (const FrameError&) {
    return newestPose(frames, target, source);
  }
}

}  // namespace

ToolPoseInput::ToolPoseInput(const ros::NodeHandle& node, const PoseSource& source, Frames& frames)
    : name_(source.name),
      fixed_frame_(source.fixed_frame),
      tool_frame_(source.frame),
      source_(source.source == ToolSource::kTf ? "tf " + fixed_frame_ + " to " + tool_frame_
                                               : node.resolveName(source.topic)),
      silence_(source.silence),
      frames_(frames) {
  if (source.source == ToolSource::kTf) {
    transforms_changed_ = frames_.onChange([this] { onTransforms(); });
  } else {
    subscriber_ = subscribeBounded<geometry_msgs::PoseStamped>(
        thread_.on(node), {source.topic, kPosesQueued, kMaxPoseSize},
        [this](const auto& event) { onMessage(*event.getConstMessage()); },
        [this](const std::string& reason) { refuse(reason); });
  }
}

std::optional<sweep_guard_core::MotionInputs::ToolPose> ToolPoseInput::newest() const {
  const sweep_guard_core::Lock lock(mutex_);
  return newest_;
}

std::string ToolPoseInput::standstill() const {
  const sweep_guard_core::Lock lock(mutex_);
  return standstill_;
}

std::optional<std::uint32_t> ToolPoseInput::publishers() const {
  return subscriber_ ? std::optional(subscriber_.getNumPublishers()) : std::nullopt;
}

void ToolPoseInput::onMessage(const geometry_msgs::PoseStamped& msg) {
  sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  record_.received(timestamps);
  try {
    if (timestamps.stamp == sweep_guard_core::Time()) throw InvalidInput("stamp is 0: stamp each pose");
    if (liesInFuture(timestamps)) throw InvalidInput(kFutureStampText);
    const Eigen::Isometry3d X_WF = nearestInTime(frames_, fixed_frame_, msg.header.frame_id, timestamps.stamp);
    accept(X_WF * fromMsg(msg.pose), timestamps);
  } catch (const sweep_guard_core::Error& error) {
    refuse(error.what());
  }
}

// Runs in the thread of the tf listener.
void ToolPoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // another transform has changed
  last_transform_ = newest;
  if (!newest) return;
  const sweep_guard_core::Timestamps timestamps{*newest, std::chrono::steady_clock::now()};
  record_.received(timestamps);
  if (*newest == sweep_guard_core::Time()) return refuseStandstill(whyItNeverMoves());
  try {
    accept(frames_.lookup(fixed_frame_, tool_frame_, *newest), timestamps);
  } catch (const sweep_guard_core::Error& error) {
    refuse(error.what());
  }
}

// Of a frame whose newest transform has the stamp 0. One that is static holds at each time.
std::string ToolPoseInput::whyItNeverMoves() const {
  if (sweep_guard_core::isSameFrame(fixed_frame_, tool_frame_))
    return "tool_frame is fixed_frame, in which it never moves";
  const bool is_static = frames_.find(fixed_frame_, tool_frame_, sweep_guard_core::Time() + kInstant).has_value();
  if (!is_static) return "the transforms to '" + tool_frame_ + "' have the stamp 0: stamp each";
  return "only static transforms place '" + tool_frame_ + "' in '" + fixed_frame_ +
         "', and none shows how it moves: publish those of the robot on /tf, or set tool_frame to a frame that moves";
}

void ToolPoseInput::refuseStandstill(const std::string& why) {
  refuse(why);
  const sweep_guard_core::Lock lock(mutex_);
  standstill_ = why;
}

void ToolPoseInput::accept(const Eigen::Isometry3d& X_WT, const sweep_guard_core::Timestamps& timestamps) {
  const sweep_guard_core::Lock lock(mutex_);
  const bool older = newest_ && timestamps.stamp < newest_->timestamps.stamp;
  if (older && timestamps.received - newest_->timestamps.received <= silence_) {
    throw InvalidInput("stamp is older than the previous pose's");
  }
  newest_ = {X_WT, timestamps};
  standstill_.clear();
}

void ToolPoseInput::refuse(const std::string& reason) {
  record_.error(reason, /*refused=*/true);
  log_.error("", name_ + " on " + source_ + " refused: " + reason);
}

}  // namespace sweep_guard_ros
