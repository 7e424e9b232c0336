#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "monitor/input_record.h"
#include "monitor/work_queue.h"
#include "ros/input/frames.h"
#include "ros/process/log_throttle.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

struct MovingFramesDependencies {
  Frames& frames;
  sweep_guard_core::FrameMotionStore& frame_motions;
  sweep_guard_core::WarningMonitor& monitor;
  sweep_guard_core::WorkQueue& queue;
  sweep_guard_core::InputRecord& record;  ///< of errors
};

/// Places the frames of the workpieces. Returns where a frame is that rests. Follows a frame that moves: samples it at the stamps
/// of poses, and whenever its newest pose changes, so that no pose waits for a transform that comes late or seldom.
class MovingFrames {
 public:
  MovingFrames(const std::string& fixed_frame, const MovingFramesDependencies& dependencies)
      : fixed_frame_(fixed_frame), dependencies_(dependencies) {}

  using Poses = std::map<std::string, Eigen::Isometry3d>;  ///< X_WM, by frame

  /// Returns the poses of those frames that rest, and follows the others. Reports those that tf does not know.
  /// @param stamp  of the pose that they are for; not earlier than before, but after time went back
  Poses locate(const std::set<std::string>& frames, sweep_guard_core::Time stamp);
  /// Returns the poses of those frames that rest.
  Poses resting(const std::set<std::string>& frames) const;

  /// Samples the frames whose newest pose has changed, and reports them to the queue. Any thread.
  void sample();

  /// Applies the static transforms that are held back, as Frames. Any thread.
  /// @param from  stamp from which on the frames that are followed are where these say
  /// @returns those of these frames that were placed anew
  std::set<std::string> applyStaticChanges(sweep_guard_core::Time from);

 private:
  struct Followed {
    NewestPose newest;
    sweep_guard_core::Time
        anew_from;  // its last change of place by a static transform: earlier poses are known no more
  };

  bool follow(const std::string& frame) REQUIRES(mutex_);
  bool follow(const std::string& frame, const NewestPose& newest) REQUIRES(mutex_);
  bool placeAnew(const std::string& frame, Followed& followed, sweep_guard_core::Time from) REQUIRES(mutex_);
  void sampleAt(const std::string& frame, sweep_guard_core::Time stamp) REQUIRES(mutex_);
  void keepOnly(const std::set<std::string>& moving) REQUIRES(mutex_);
  void report(const std::string& frame, const FrameError& error);
  void forgetWanted() REQUIRES(mutex_);

  const std::string fixed_frame_;
  const MovingFramesDependencies dependencies_;
  sweep_guard_core::Mutex mutex_;
  std::map<std::string, Followed> followed_ GUARDED_BY(mutex_);
  std::deque<sweep_guard_core::Time> wanted_
      GUARDED_BY(mutex_);  // stamps of poses at which one of them is not known yet
  std::vector<sweep_guard_core::FramePose> samples_ GUARDED_BY(mutex_);  // of one of them
  LogThrottle log_;
};

}  // namespace sweep_guard_ros
