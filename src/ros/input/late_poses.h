#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>

#include "monitor/work_queue.h"
#include "ros/input/frames.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// A pose of the tool as it was received.
struct ReceivedPose {
  sweep_guard_core::Timestamps timestamps;
  std::string frame;
  Eigen::Isometry3d X_FT;
  /// When it was received. Taken first: a pose that does not know of a change does not end its fault.
  sweep_guard_core::WarningMonitor::Checkpoint checkpoint = {};
  std::uint64_t static_changes = 0;  ///< as Frames counted them then
};

/// Locates poses of the tool in the fixed frame, in their order. A pose whose transform is late waits for it, and those that come
/// after it wait, too. When another pose or transform comes, it is located, or refused if it has waited for longer than
/// `timing/pose_timeout`. A pose that waited is received when it is located. One thread.
class LatePoses {
 public:
  /// Both must outlive this.
  LatePoses(const LiveParameters& live, Frames& frames) : live_(live), frames_(frames) {}

  /// Sets that changes of the transforms of a frame count from now on. Before poses in it are located.
  void use(const std::string& frame);

  /// Locates a pose that has come; empty: it waits.
  /// @throws FrameError if there is no transform
  std::optional<sweep_guard_core::QueuedPose> locate(const ReceivedPose& pose);

  /// Locates the first pose that waits; empty: none waits, or its transform may still come.
  /// @throws FrameError if there is no transform; then the pose is left out
  std::optional<sweep_guard_core::QueuedPose> locateNext();

  /// Locates the tool frame for a state of joints; empty: its transform may still come. The time to wait begins with the
  /// first call for a state.
  /// @throws FrameError if there is no transform
  std::optional<Eigen::Isometry3d> locateToolFrame(sweep_guard_core::Time stamp);

  /// Leaves out the second pose of too many that wait. Returns whether there were too many.
  bool leaveOutIfFull();

  void clear();  ///< forgets the poses

  bool empty() const { return waiting_.empty() && !joints_wait_since_; }  ///< nothing waits
  bool jointsWait() const { return joints_wait_since_.has_value(); }      ///< for locateToolFrame()
  std::optional<sweep_guard_core::Time> newest() const;                   ///< stamp; empty: none has come
  const std::string& frame() const { return frame_; }                     ///< of the newest pose that is located
  bool hasBegunToWait() { return has_begun_to_wait_.exchange(false); }    ///< since the last call. Any thread

 private:
  std::optional<sweep_guard_core::QueuedPose> locate(const ReceivedPose& pose, sweep_guard_core::SteadyTime known);
  std::optional<Eigen::Isometry3d> find(const std::string& frame, sweep_guard_core::Time stamp,
                                        sweep_guard_core::SteadyTime since);

  const LiveParameters& live_;
  Frames& frames_;
  std::deque<ReceivedPose> waiting_;                               // for the transform of the first
  std::optional<sweep_guard_core::SteadyTime> joints_wait_since_;  // the next state
  std::atomic<bool> has_begun_to_wait_ = false;                    // any of these
  std::optional<sweep_guard_core::Time> located_;                  // stamp of the newest
  std::string frame_;
  std::set<std::string> used_;
};

}  // namespace sweep_guard_ros
