#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "guard/workpiece_store.h"
#include "monitor/input_record.h"
#include "ros/bounded.h"
#include "ros/input/articulated_tool.h"
#include "ros/input/frames.h"
#include "ros/input/jump_watch.h"
#include "ros/log_throttle.h"
#include "ros/parameters/parameters.h"
#include "ros/threads/queue_thread.h"
#include "ros/work_queue.h"
#include "sweep_guard/guard/frame_motion.h"

namespace sweep_guard_ros {

struct PoseInputDependencies {
  Frames& frames;
  const sweep_guard_core::WorkpieceStore& workpieces;
  sweep_guard_core::WarningMonitor& monitor;
  WorkQueue& queue;
  const sweep_guard_core::FrameMotionStore* frame_motions = nullptr;  ///< of frames that tf does not have
};

/// Takes tool poses from the topic `tool_pose` or from tf, and positions of joints from `joint_states`, refuses bad ones,
/// looks up the frames of the workpieces, and queues the poses in their order. Has its own thread, because a transform may
/// be up to 20 ms late.
class PoseInput {
 public:
  PoseInput(const ros::NodeHandle& node, const LiveParameters& live, const PoseInputDependencies& dependencies);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"poses", sweep_guard_core::Stage::kReceive}); }

  const sweep_guard_core::InputRecord& record() const { return record_; }
  const std::string& source() const { return source_; }  ///< resolved topics, or the tf frames
  std::optional<std::uint32_t> publishers() const;       ///< of the topic; empty for tf
  std::uint64_t lost() const { return lost_; }           ///< poses that were sent and did not arrive, by header.seq

 private:
  struct ReceivedPose {
    sweep_guard_core::Timestamps timestamps;
    std::string frame;
    Eigen::Isometry3d X_FT;
  };

  void onMessage(const ros::MessageEvent<const geometry_msgs::PoseStamped>& event);
  void countLost(const std::string& publisher, std::uint32_t sequence);
  bool hasSeveralPublishers() const;
  void reportConflict();
  void onTransforms();
  template <typename Accept>
  void refuseWhatFails(const Accept& accept);
  void accept(const ReceivedPose& pose);
  void acceptJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event);
  void begin();
  void pushKnownPoses(sweep_guard_core::SteadyTime received);
  std::string jumpTo(const ArticulatedTool::Pose& state);
  void push(sweep_guard_core::SteadyTime received, ArticulatedTool::Pose pose);
  std::map<std::string, Eigen::Isometry3d> locate(const std::set<std::string>& mesh_frames,
                                                  sweep_guard_core::Time stamp);
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp);
  Eigen::Isometry3d waitFor(const std::string& target, const std::string& source, sweep_guard_core::Time stamp);
  void refuse(sweep_guard_core::Reason reason, const std::string& message);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  const std::string source_;
  const bool allow_several_publishers_;
  const bool tool_in_tf_;
  Frames& frames_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  WorkQueue& queue_;
  const sweep_guard_core::FrameMotionStore* const frame_motions_;

  sweep_guard_core::WarningMonitor::Checkpoint checkpoint_;  // of the previous pose
  std::optional<sweep_guard_core::Time> previous_stamp_;
  std::string pose_frame_;  // of the newest pose
  JumpWatch jumps_;
  std::optional<sweep_guard_core::Time> last_transform_;  // used by the tf listener's thread only
  // Missing transforms by target and source, each with the stamp of the newest one that there was.
  std::map<std::pair<std::string, std::string>, std::optional<sweep_guard_core::Time>> missing_;
  bool waited_ = false;                         // without success, for a transform of the newest pose
  sweep_guard_core::SteadyTime no_wait_until_;  // for frames that tf does not know
  std::string publisher_;                       // of the previous pose
  std::uint32_t sequence_ = 0;                  // of the previous pose
  std::atomic<std::uint64_t> lost_ = 0;
  std::atomic<size_t> waiting_ = 0;  // poses from tf
  LogThrottle log_;
  sweep_guard_core::InputRecord record_;

  std::unique_ptr<ArticulatedTool> articulated_;  // null for a rigid tool
  std::vector<ArticulatedTool::Pose> known_;      // up to the newest state

  QueueThread thread_;  // before the subscribers, which use its queue
  std::shared_ptr<void> transforms_changed_;
  BoundedSubscriber subscriber_;
  BoundedSubscriber joints_;
};

}  // namespace sweep_guard_ros
