#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "guard/workpiece_store.h"
#include "monitor/work_queue.h"
#include "ros/input/frames.h"
#include "ros/input/moving_frames.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Adds the frames of workpieces that rest to poses of the tool, which are queued then. After a static transform has changed, the
/// path to the next pose is swept where things were, then where they are: place() gives it in the old place, the caller applies
/// the changes, repeat() gives it in the new one. Several changes count as one. One thread.
class ToolPath {
 public:
  using Checkpoint = sweep_guard_core::WarningMonitor::Checkpoint;

  ToolPath(const std::string& fixed_frame, Frames& frames, const sweep_guard_core::WorkpieceStore& workpieces,
           MovingFrames& moving_frames)
      : fixed_frame_(fixed_frame), frames_(frames), workpieces_(workpieces), moving_frames_(moving_frames) {}

  /// Notes an input that is accepted, before it is placed.
  /// @param static_changes  as Frames counted them when it was received
  void note(sweep_guard_core::Time stamp, std::uint64_t static_changes);

  /// Places the poses of a motion.
  /// @param poses        at least one; their contents are moved from
  /// @param frame        that the newest pose of the tool was given in
  /// @param checkpoint   when they were received
  /// @param[out] placed  overwritten
  /// @returns the stamp from which on changed static transforms are to be applied, before repeat(); empty: none
  std::optional<sweep_guard_core::Time> place(std::vector<sweep_guard_core::PoseWithFrames>& poses,
                                              const std::string& frame, const Checkpoint& checkpoint,
                                              std::vector<sweep_guard_core::QueuedPose>& placed);

  /// Ends the path at the newest pose, for changes that no pose comes after.
  /// @param static_changes  as Frames counts them
  /// @returns as place()
  sweep_guard_core::Time endAtNewest(std::uint64_t static_changes);

  /// Places the path since the change again, where things are.
  /// @param frames       that are followed and were placed anew
  /// @param[out] placed  overwritten
  void repeat(std::set<std::string> frames, const Checkpoint& checkpoint,
              std::vector<sweep_guard_core::QueuedPose>& placed);

  void clear();  ///< forgets where the tool was

 private:
  // A pose, and where the frame was that it was given in. Keeps its memory from one pose to the next.
  struct PoseInFrame {
    sweep_guard_core::PoseWithFrames pose;
    Checkpoint checkpoint;
    std::string frame;
    std::optional<Eigen::Isometry3d> X_WF;  // at its stamp; empty: not known, or there is no pose
  };

  void useWorkpieceFrames();
  void placeFrames(sweep_guard_core::PoseWithFrames& pose, const std::string& frame, const Checkpoint& checkpoint);
  bool movePath();

  const std::string fixed_frame_;
  Frames& frames_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  MovingFrames& moving_frames_;
  std::shared_ptr<const std::set<std::string>> workpiece_frames_;  // that are in use
  std::uint64_t static_changes_ = 0;                               // by the newest input
  std::optional<sweep_guard_core::Time> newest_stamp_;             // of all inputs
  // Static transforms that count have changed, and are not applied yet: the motion up to this stamp was before.
  std::optional<sweep_guard_core::Time> changed_after_;
  PoseInFrame placed_;             // the newest
  std::vector<PoseInFrame> path_;  // on which a static transform changed
  sweep_guard_core::Time repeat_at_;
  size_t anew_ = 0;  // of the path, so many poses did not move to where they are
};

}  // namespace sweep_guard_ros
