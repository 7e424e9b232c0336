#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "guard/recent_poses.h"
#include "guard/workpiece_store.h"
#include "monitor/input_record.h"
#include "monitor/sequence_gaps.h"
#include "monitor/work_queue.h"
#include "ros/connection/bounded.h"
#include "ros/input/articulated_tool.h"
#include "ros/input/frames.h"
#include "ros/input/late_poses.h"
#include "ros/input/moving_frames.h"
#include "ros/input/resting_pose.h"
#include "ros/input/state_watch.h"
#include "ros/input/tool_path.h"
#include "ros/parameters/live_parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/guard/frame_motion.h"

namespace sweep_guard_ros {

struct PoseInputDependencies {
  Frames& frames;
  const sweep_guard_core::WorkpieceStore& workpieces;
  sweep_guard_core::WarningMonitor& monitor;
  sweep_guard_core::WorkQueue& queue;
  sweep_guard_core::FrameMotionStore& frame_motions;
  sweep_guard_core::RecentPoses& recent_poses;
};

/// Takes tool poses from the topic `tool_pose` or from tf, and positions of joints from `joint_states`, and refuses bad
/// ones. LatePoses locates the poses in the fixed frame, ToolPath adds the frames of workpieces that rest; then they are queued.
class PoseInput {
 public:
  PoseInput(const ros::NodeHandle& node, const LiveParameters& live, const PoseInputDependencies& dependencies);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"poses", sweep_guard_core::Stage::kReceive}); }

  const sweep_guard_core::InputRecord& record() const { return record_; }
  const std::string& source() const { return source_; }  ///< resolved topics, or the tf frames
  std::optional<std::uint32_t> publishers() const;       ///< of the topic of poses; empty: there is none
  const sweep_guard_core::RepeatedPositions& repeated() const { return watch_.repeated(); }
  std::uint64_t lost() const { return lost_; }  ///< poses that were sent and did not arrive, by header.seq

  /// Applies changes of static transforms that are held back for longer than `timing/pose_timeout`, unless poses wait. Any thread.
  void applyLateChanges();

  /// Adds the pose of now of a tool from tf that no transform moves: it is at rest. Does so once in a cycle (`timing/min_rate`), or
  /// twice in `timing/pose_timeout` if that is more often, by either clock. To be called often, by one thread.
  void addRestingPose();

 private:
  using Checkpoint = sweep_guard_core::WarningMonitor::Checkpoint;

  void onMessage(const ros::MessageEvent<const geometry_msgs::PoseStamped>& event);
  void countLost(const std::string& publisher, std::uint32_t sequence);
  bool hasSeveralPublishers() const;
  void reportConflicts();
  void reportConflict(const std::string& conflict);
  void reportRefusal();
  void onRefusal();
  void onTransforms();
  void addPoseOfFrame(sweep_guard_core::Time stamp, bool rests);
  void accept(ReceivedPose pose, bool rests = false);
  void onJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event);
  void passOver(const sensor_msgs::JointState& joints);
  void acceptJoints(const sensor_msgs::JointState& joints, const std::string& sender, const std::string& named);
  void begin(const Checkpoint& checkpoint);
  void onFramesMoved();
  void pushWaiting();
  void pushAllWaiting();
  void pushLocated(const sweep_guard_core::QueuedPose& located);
  void pushKnownPoses(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint);
  void push(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint);
  void reportSilence(sweep_guard_core::Time stamp);
  void repeat(sweep_guard_core::Time changed_from, const Checkpoint& checkpoint);
  std::set<std::string> applyStaticChanges(sweep_guard_core::Time from);
  void refuseCaught(const std::string& sender = "");
  void refuse(sweep_guard_core::Reason reason, const std::string& message);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  const std::string source_;
  const bool allow_several_publishers_;
  const LiveParameters& live_;
  Frames& frames_;
  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::WorkQueue& queue_;
  sweep_guard_core::RecentPoses& recent_poses_;

  Checkpoint checkpoint_;                                 // of the previous input
  std::optional<sweep_guard_core::Time> last_transform_;  // used by onTransforms() only
  RestingPose resting_;
  sweep_guard_core::Time rested_until_;  // stamp of the newest pose of a tool from tf at rest
  sweep_guard_core::SequenceGaps gaps_;  // in header.seq
  std::atomic<std::uint64_t> lost_ = 0;
  std::atomic<size_t> waiting_ = 0;  // poses from tf
  LogThrottle log_;
  sweep_guard_core::InputRecord record_;
  StateWatch watch_;
  MovingFrames moving_frames_;
  LatePoses late_;
  ToolPath path_;

  std::unique_ptr<ArticulatedTool> articulated_;         // null for a rigid tool
  std::vector<sweep_guard_core::PoseWithFrames> known_;  // up to the newest state or pose
  std::vector<sweep_guard_core::QueuedPose> placed_;     // the same, to be queued

  QueueThread thread_;  // before the subscribers, which use its queue
  std::shared_ptr<void> transforms_changed_;
  std::shared_ptr<void> frames_moved_;
  std::shared_ptr<void> transforms_refused_;
  BoundedSubscriber subscriber_;
  BoundedSubscriber joints_;
};

}  // namespace sweep_guard_ros
