#pragma once

#include <vector>

#include "recording/level_trace.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// Interpolates a recording as the guard does: between two poses the tool moves straight and turns about one axis, both
/// at constant rate (lerp and slerp). Of poses with equal stamps the last one counts.
class RecordedMotion {
 public:
  /// @param poses  at least one, stamps not decreasing
  explicit RecordedMotion(const std::vector<sweep_guard_core::StampedPose>& poses);

  const std::vector<sweep_guard_core::StampedPose>& poses() const { return poses_; }  ///< stamps strictly ascending

  /// Returns the intervals without a gap in ascending order. A gap is an interval longer than both 0.25 s and three median intervals,
  /// as for PosePredictor.
  const std::vector<sweep_guard_recording::TimeInterval>& segments() const { return segments_; }

  /// Returns whether one segment contains both times.
  bool isContinuous(sweep_guard_core::Time from, sweep_guard_core::Time to) const;

  /// Returns the index of the newest pose at `time`, which must not be before the first pose.
  size_t newestAt(sweep_guard_core::Time time) const;

  /// Returns the pose X_WT at a time.
  /// @param time  from the first to the last stamp
  Eigen::Isometry3d at(sweep_guard_core::Time time) const;

 private:
  std::vector<sweep_guard_core::StampedPose> poses_;
  std::vector<sweep_guard_recording::TimeInterval> segments_;
};

}  // namespace sweep_guard_evaluation
