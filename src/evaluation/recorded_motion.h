#pragma once

#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// The motion that a recording is taken for: between its poses the tool goes straight and turns about one axis at
/// constant rate (lerp and slerp), as in the guard. Of poses that share a stamp the last one holds.
class RecordedMotion {
 public:
  /// A part of the recording without a gap.
  struct Segment {
    sweep_guard_core::Time begin;
    sweep_guard_core::Time end;
  };

  /// @param poses  at least one, stamps not decreasing
  explicit RecordedMotion(const std::vector<sweep_guard_core::StampedPose>& poses);

  const std::vector<sweep_guard_core::StampedPose>& poses() const { return poses_; }  ///< stamps ascending, each once

  /// Ascending. A gap is an interval of more than 0.25 s and three median ones, as for PosePredictor.
  const std::vector<Segment>& segments() const { return segments_; }

  /// No gap and no end of the recording between the two.
  bool unbroken(sweep_guard_core::Time from, sweep_guard_core::Time to) const;

  /// Index of the newest pose at a time not before the first pose.
  size_t newestAt(sweep_guard_core::Time time) const;

  /// Where the tool was.
  /// @param time  from the first to the last stamp
  Eigen::Isometry3d at(sweep_guard_core::Time time) const;

 private:
  std::vector<sweep_guard_core::StampedPose> poses_;
  std::vector<Segment> segments_;
};

}  // namespace sweep_guard_evaluation
