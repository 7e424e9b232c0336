#include "ros/input/pose_input.h"

#include <boost/make_shared.hpp>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr auto kPoseTransformWait = std::chrono::milliseconds(20);
constexpr size_t kMaxMissing = 64;         // bounds the memory that made-up frame names can take
constexpr std::uint32_t kQueueLength = 0;  // unbounded: a pose that ROS drops is a gap that nobody notices

struct PoseRefused : sweep_guard_core::InvalidInput {
  PoseRefused(Reason why, const std::string& message) : InvalidInput(message), reason(why) {}
  Reason reason;
};

class Call : public ros::CallbackInterface {
 public:
  explicit Call(std::function<void()> function) : function_(std::move(function)) {}
  CallResult call() override {
    function_();
    return Success;
  }

 private:
  std::function<void()> function_;
};

}  // namespace

PoseInput::PoseInput(const ros::NodeHandle& node, const Parameters& parameters,
                     const PoseInputDependencies& dependencies)
    : fixed_frame_(parameters.fixed_frame),
      tool_frame_(parameters.tool_frame),
      frames_(dependencies.frames),
      workpieces_(dependencies.workpieces),
      monitor_(dependencies.monitor),
      queue_(dependencies.queue) {
  if (parameters.tool_source == ToolSource::kTf) {
    transforms_changed_ = frames_.onChange([this] { onTransforms(); });
  } else {
    subscriber_ = thread_.on(node).subscribe("tool_pose", kQueueLength, &PoseInput::onMessage, this,
                                             ros::TransportHints().tcpNoDelay());
  }
}

std::string PoseInput::source() const {
  return subscriber_ ? subscriber_.getTopic() : "tf " + fixed_frame_ + " to " + tool_frame_;
}

std::optional<std::uint32_t> PoseInput::publishers() const {
  return subscriber_ ? std::optional(subscriber_.getNumPublishers()) : std::nullopt;
}

void PoseInput::onMessage(const geometry_msgs::PoseStamped& msg) {
  const sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  acceptOrRefuse(timestamps, [&] {
    try {
      return ReceivedPose{timestamps, msg.header.frame_id, fromMsg(msg.pose)};
    } catch (const sweep_guard_core::InvalidInput& error) {
      throw PoseRefused(sweep_guard_core::kPoseInvalid, error.what());
    }
  });
}

// Runs in the thread of the tf listener, which must not wait for transforms: only reads the pose.
void PoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // another transform has changed
  last_transform_ = newest;
  if (!newest) return;
  try {
    const ReceivedPose pose{
        {*newest, std::chrono::steady_clock::now()}, fixed_frame_, frames_.lookup(fixed_frame_, tool_frame_, *newest)};
    thread_.queue().addCallback(
        boost::make_shared<Call>([this, pose] { acceptOrRefuse(pose.timestamps, [pose] { return pose; }); }));
  } catch (const FrameError& error) {
    record_.error(error.what(), /*refused=*/false);
    monitor_.fault(sweep_guard_core::kTfFail, error.what());
  }
}

void PoseInput::acceptOrRefuse(const sweep_guard_core::Timestamps& timestamps,
                               const std::function<ReceivedPose()>& read) {
  record_.received(timestamps);
  try {
    accept(read());
  } catch (const PoseRefused& error) {
    refuse(error.reason, error.what());
  } catch (const FrameError& error) {
    refuse(sweep_guard_core::kTfFail, error.what());
  } catch (const std::exception& error) {  // out of memory
    refuse(sweep_guard_core::kPoseInvalid, error.what());
  }
}

void PoseInput::refuse(Reason reason, const std::string& message) {
  record_.error(message, /*refused=*/true);
  monitor_.fault(reason, "tool pose refused: " + message);
  log_.error(std::to_string(reason), "tool pose on " + source() + " refused: " + message);
}

void PoseInput::accept(const ReceivedPose& pose) {
  const sweep_guard_core::WarningMonitor::Checkpoint checkpoint = monitor_.checkpoint();
  if (!checkpoint.continues(checkpoint_)) previous_stamp_.reset();
  checkpoint_ = checkpoint;
  const auto& [stamp, received] = pose.timestamps;
  checkStamp(stamp);
  const Eigen::Isometry3d X_WT = lookup(fixed_frame_, pose.frame, stamp) * pose.X_FT;
  previous_stamp_ = stamp;
  queue_.push({{stamp, received, X_WT, locate(*workpieces_.frames(), stamp)}, checkpoint});
}

void PoseInput::checkStamp(sweep_guard_core::Time stamp) const {
  if (stamp == sweep_guard_core::Time())
    throw PoseRefused(sweep_guard_core::kPoseInvalid, "stamp is 0: stamp each pose");
  if (liesInFuture(stamp)) throw PoseRefused(sweep_guard_core::kFutureStamp, kFutureStampText);
  if (previous_stamp_ && stamp < *previous_stamp_) {
    throw PoseRefused(sweep_guard_core::kOutOfOrder, "stamp is older than the previous pose's");
  }
}

std::map<std::string, Eigen::Isometry3d> PoseInput::locate(const std::set<std::string>& mesh_frames,
                                                           sweep_guard_core::Time stamp) {
  std::map<std::string, Eigen::Isometry3d> X_WM;
  for (const std::string& frame : mesh_frames) {
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

// Waits for a late transform, but not again while its publisher is silent: that would delay every pose.
Eigen::Isometry3d PoseInput::lookup(const std::string& target, const std::string& source,
                                    sweep_guard_core::Time stamp) {
  const std::pair frames(target, source);
  const auto missed = missing_.find(frames);
  const bool silent = missed != missing_.end() && missed->second == frames_.newest(target, source);
  try {
    Eigen::Isometry3d X =
        frames_.lookup(target, source, stamp, silent ? sweep_guard_core::Duration(0) : kPoseTransformWait);
    if (missed != missing_.end()) missing_.erase(missed);
    return X;
  } catch (const FrameError&) {
    if (missing_.size() >= kMaxMissing) missing_.clear();
    missing_[frames] = frames_.newest(target, source);
    throw;
  }
}

}  // namespace sweep_guard_ros
