#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <memory>
#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/input/frames.h"
#include "ros/motion/pose_source.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_ros {

/// Keeps the newest pose of the tool, or of another frame, from a topic or from tf. Looks transforms up as they are: a pose whose
/// frame has no transform at its stamp takes the newest one. A frame in tf that only static transforms place has no pose: where
/// it is says nothing of what moves it.
class ToolPoseInput {
 public:
  ToolPoseInput(const ros::NodeHandle& node, const PoseSource& source, Frames& frames);

  /// @param thread  name of its thread
  void start(Supervisor& supervisor, const char* thread = "poses") {
    thread_.start(supervisor, {thread, sweep_guard_core::Stage::kReceive});
  }

  std::optional<sweep_guard_core::MotionInputs::ToolPose> newest() const;  ///< any thread

  /// Returns why transforms that came place the frame and never show that it moves, in words; empty: they may.
  std::string standstill() const;

  const sweep_guard_core::InputRecord& record() const { return record_; }
  const std::string& source() const { return source_; }  ///< resolved topic, or the tf frames
  std::optional<std::uint32_t> publishers() const;       ///< of the topic; empty for tf

 private:
  void onMessage(const geometry_msgs::PoseStamped& msg);
  void onTransforms();
  std::string whyItNeverMoves() const;
  void refuseStandstill(const std::string& why);
  void accept(const Eigen::Isometry3d& X_WT, const sweep_guard_core::Timestamps& timestamps);
  void refuse(const std::string& reason);

  const std::string name_;
  const std::string fixed_frame_;
  const std::string tool_frame_;
  const std::string source_;
  const sweep_guard_core::Duration silence_;
  Frames& frames_;
  mutable sweep_guard_core::Mutex mutex_;
  std::optional<sweep_guard_core::MotionInputs::ToolPose> newest_ GUARDED_BY(mutex_);
  std::string standstill_ GUARDED_BY(mutex_);
  std::optional<sweep_guard_core::Time> last_transform_;  // used by the tf listener's thread only
  sweep_guard_core::InputRecord record_;
  LogThrottle log_;
  QueueThread thread_;  // before the subscriber, which uses its queue
  std::shared_ptr<void> transforms_changed_;
  BoundedSubscriber subscriber_;
};

}  // namespace sweep_guard_ros
