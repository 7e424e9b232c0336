#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "guard/workpiece_store.h"
#include "monitor/input_record.h"
#include "monitor/work_queue.h"
#include "ros/connection/bounded.h"
#include "ros/input/articulated_tool.h"
#include "ros/input/frames.h"
#include "ros/input/jump_watch.h"
#include "ros/input/moving_frames.h"
#include "ros/parameters/parameters.h"
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
};

/// Takes tool poses from the topic `tool_pose` or from tf, and positions of joints from `joint_states`, refuses bad ones,
/// places them and the frames of the workpieces, and queues the poses in their order. A pose whose own transform is late waits for it,
/// for up to `timing/pose_timeout`, and those that come after it wait, too.
class PoseInput {
 public:
  PoseInput(const ros::NodeHandle& node, const LiveParameters& live, const PoseInputDependencies& dependencies);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"poses", sweep_guard_core::Stage::kReceive}); }

  const sweep_guard_core::InputRecord& record() const { return record_; }
  const std::string& source() const { return source_; }  ///< resolved topics, or the tf frames
  std::optional<std::uint32_t> publishers() const;       ///< of the topic; empty for tf
  std::uint64_t lost() const { return lost_; }           ///< poses that were sent and did not arrive, by header.seq

  /// Applies static transforms that have changed though no pose has come for `timing/pose_timeout`. Any thread.
  void applyLateChanges();

 private:
  using Checkpoint = sweep_guard_core::WarningMonitor::Checkpoint;

  struct ReceivedPose {
    sweep_guard_core::Timestamps timestamps;
    std::string frame;
    Eigen::Isometry3d X_FT;
  };
  struct WaitingPose {
    ReceivedPose pose;
    Checkpoint checkpoint;
  };
  // What was so when an input was received.
  struct Receipt {
    Checkpoint checkpoint;         // taken first: a pose that does not know of a change does not end its fault
    std::uint64_t static_changes;  // as Frames counts them
  };
  // A pose, and where the frame was that it was given in. Keeps its memory from one pose to the next.
  struct PoseInFrame {
    sweep_guard_core::PoseWithFrames pose;
    Checkpoint checkpoint;
    std::string frame;
    std::optional<Eigen::Isometry3d> X_WF;  // at its stamp; empty: not known, or there is no pose
  };

  void onMessage(const ros::MessageEvent<const geometry_msgs::PoseStamped>& event);
  void countLost(const std::string& publisher, std::uint32_t sequence);
  bool hasSeveralPublishers() const;
  void reportConflict();
  void onTransforms();
  template <typename Accept>
  void refuseWhatFails(const Accept& accept);
  void accept(const ReceivedPose& pose, const Receipt& receipt);
  void acceptJoints(const ros::MessageEvent<const sensor_msgs::JointState>& event);
  Receipt receipt() const;
  void begin(const Receipt& receipt);
  void noteStamp(sweep_guard_core::Time stamp, const Receipt& receipt);
  void placeWaiting();
  bool placeNext();
  bool place(const WaitingPose& waiting, sweep_guard_core::SteadyTime known);
  std::optional<Eigen::Isometry3d> place(const std::string& frame, sweep_guard_core::Time stamp,
                                         sweep_guard_core::SteadyTime received);
  std::optional<Eigen::Isometry3d> placeRoot(sweep_guard_core::Time stamp);
  void onFramesMoved();
  void placeAllWaiting();
  void useToolFrame(const std::string& frame);
  void useWorkpieceFrames();
  void pushKnownPoses(sweep_guard_core::SteadyTime received, const Checkpoint& checkpoint);
  void push(std::vector<ArticulatedTool::Pose>& poses, sweep_guard_core::SteadyTime received,
            const Checkpoint& checkpoint);
  sweep_guard_core::PoseWithFrames place(ArticulatedTool::Pose& pose, sweep_guard_core::SteadyTime received,
                                         const Checkpoint& checkpoint);
  void push(sweep_guard_core::PoseWithFrames pose, const Checkpoint& checkpoint);
  void pushPathAnew(sweep_guard_core::Time stamp, size_t anew, const Checkpoint& checkpoint);
  std::set<std::string> applyStaticChanges(sweep_guard_core::Time from);
  bool movePath();
  std::string jumpTo(const ArticulatedTool::Pose& state);
  void refuse(sweep_guard_core::Reason reason, const std::string& message);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  const std::string source_;
  const bool allow_several_publishers_;
  const LiveParameters& live_;
  Frames& frames_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::WorkQueue& queue_;

  Checkpoint checkpoint_;  // of the previous input
  std::optional<sweep_guard_core::Time> previous_stamp_;
  std::deque<WaitingPose> waiting_poses_;                          // for the transform of the first
  std::optional<sweep_guard_core::SteadyTime> root_waits_since_;   // of the next state of the joints
  std::atomic<bool> waits_ = false;                                // any of these
  std::set<std::string> tool_frames_;                              // that poses were given in
  std::string tool_given_in_;                                      // the newest of these
  std::shared_ptr<const std::set<std::string>> workpiece_frames_;  // that are in use
  PoseInFrame placed_;                                             // the newest
  std::vector<PoseInFrame> path_;                                  // on which a static transform changed
  std::uint64_t static_changes_ = 0;                               // by the newest input
  std::optional<sweep_guard_core::Time> newest_stamp_;             // of all inputs
  // Static transforms that count have changed, and are not applied yet: the motion up to this stamp was before.
  std::optional<sweep_guard_core::Time> changed_after_;
  JumpWatch jumps_;
  std::optional<sweep_guard_core::Time> last_transform_;  // used by the tf listener's thread only
  std::string publisher_;                                 // of the previous pose
  std::uint32_t sequence_ = 0;                            // of the previous pose
  std::atomic<std::uint64_t> lost_ = 0;
  std::atomic<size_t> waiting_ = 0;  // poses from tf
  LogThrottle log_;
  sweep_guard_core::InputRecord record_;
  MovingFrames moving_frames_;

  std::unique_ptr<ArticulatedTool> articulated_;  // null for a rigid tool
  std::vector<ArticulatedTool::Pose> known_;      // up to the newest state

  QueueThread thread_;  // before the subscribers, which use its queue
  std::shared_ptr<void> transforms_changed_;
  std::shared_ptr<void> frames_moved_;
  BoundedSubscriber subscriber_;
  BoundedSubscriber joints_;
};

}  // namespace sweep_guard_ros
