#pragma once

#include <vector>

#include "sweep_guard/geometry/merged_motion.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// A segment of an expected motion: one step between two of its poses or a part of one, or several whole steps.
struct PathSegment {
  Duration from{};   ///< after the newest measured pose
  Duration to{};     ///< after the newest measured pose, > `from`
  size_t first = 0;  ///< last pose not after `from`; pose 0 is the measured one
  size_t last = 1;   ///< first pose not before `to`
};

/// How the tool is expected to move, seen from a mesh frame M that stays where it is: from pose to pose of a predicted
/// path straight at constant speed, turning about one axis at constant rate. Keeps its buffers from one path to the
/// next.
class PathInMesh {
 public:
  /// Must be called before anything else is asked.
  /// @param X_WT  where the path begins
  /// @param path  at least one pose
  void follow(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
              const Eigen::Isometry3d& X_WM);

  PathSegment whole() const { return between(0, path_M_.size() - 1); }

  /// From pose to pose; the measured pose is number 0, the path's begin at 1.
  PathSegment between(size_t first, size_t last) const {
    return {path_M_[first].time, path_M_[last].time, first, last};
  }

  /// Cut at a pose in its middle if there is one, else in half.
  std::pair<PathSegment, PathSegment> halves(const PathSegment& segment) const;

  /// The motions to sweep, end to end. Part of a step is split(); several steps are one motion, their mergedMotion().
  /// @param max_rotation    of a part of one step [rad]
  /// @param[out] motions_M  what was in it is replaced
  void motions_M(const PathSegment& segment, double max_rotation, std::vector<Motion>& motions_M) const;

  /// The pose at the segment's end.
  Eigen::Isometry3d end_M(const PathSegment& segment) const { return at(segment.to, segment.last - 1).X_MT; }

  /// Of that pose's error: translation [m], then rotation vector [rad], along the axes of M. Between two poses it grows
  /// evenly, from 0 at the measured one.
  Matrix6d covariance_M(const PathSegment& segment) const { return at(segment.to, segment.last - 1).covariance_M; }

  /// Holds every tool point all along a segment, off by up to `deviations` standard deviations.
  /// @param margin  the tool is grown by this [m], >= 0
  Eigen::AlignedBox3d reach_M(const PathSegment& segment, double deviations, double margin) const;

 private:
  struct Pose {
    Eigen::Isometry3d X_MT;
    Matrix6d covariance_M;
  };

  Pose at(Duration time, size_t first) const;

  Eigen::AlignedBox3d tool_T_;
  double tool_radius_ = 0.0;
  Path path_M_;
  std::vector<Matrix6d> covariances_M_;  // at the path
};

/// Where the sweeps along a path end: numbers of poses, counted as by PathInMesh, the last of them the path's end.
/// The reflex interval is swept from pose to pose; the rest in about `considered_sweeps` sweeps of as many steps each,
/// but no two steps that turn by more than 1.5 rad together are joined.
/// @param considered_sweeps  >= 1
/// @param[out] ends          what was in it is replaced
void sweepEnds(const Eigen::Isometry3d& X_WT, const PredictedPath& path, size_t reflex_sweeps, size_t considered_sweeps,
               std::vector<size_t>& ends);

}  // namespace sweep_guard_core
