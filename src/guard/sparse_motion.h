#pragma once

#include "geometry/merged_motion.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_core {

/// Replaces the poses of a body by fewer ones, and bounds how far the body was meanwhile from where they say.
class SparseMotion {
 public:
  /// @param radius  largest distance of a point of the body from the origin of its frame [m], >= 0
  explicit SparseMotion(double radius) : radius_(radius) {}

  /// Adds the newest pose; stamps do not decrease.
  void add(Time stamp, const BodyPose& pose);

  /// Returns the newest pose with the bound for the motion since the pose returned before; 0 if there is none. There must be
  /// a pose (asserted).
  BodyPose take();

  void clear() { path_W_.clear(); }  ///< forgets all poses

 private:
  double radius_;
  Time first_;
  Path path_W_;  // since the pose returned before
  double deviation_bound_ = 0.0;
};

}  // namespace sweep_guard_core
