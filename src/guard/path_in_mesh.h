#pragma once

#include <utility>
#include <vector>

#include "guard/out_of_reach.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// A segment of a predicted path: one step between two poses, a fraction of a step, or several whole steps.
struct PathSegment {
  Duration from{};   ///< after the newest measured pose
  Duration to{};     ///< after the newest measured pose, > `from`
  size_t first = 0;  ///< last pose not after `from`; pose 0 is the measured one
  size_t last = 1;   ///< first pose not before `to`
};

/// Expresses a predicted path in a mesh frame M that stays where it is, or that moves along a path of its own. Between poses
/// the tool moves straight at constant speed and turns about one axis at constant rate. Keeps its buffers from one path to the
/// next.
class PathInMesh {
 public:
  /// Sets the path; must be called before any other function.
  /// @param X_WT  where the path begins
  /// @param path  at least one pose
  void follow(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
              const Eigen::Isometry3d& X_WM);
  /// Sets the path in a frame that moves as framePath() says. The covariances become those of the tool relative to the frame: the errors of both
  /// count as independent.
  void follow(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
              const std::vector<PredictedFrame>& frame);

  PathSegment whole() const { return between(0, path_M_.size() - 1); }

  /// Returns the segment between two poses. The measured pose is number 0; the poses of the path begin at 1.
  PathSegment between(size_t first, size_t last) const {
    return {path_M_[first].time, path_M_[last].time, first, last};
  }

  /// Cuts a segment at a pose in its middle, or in half if there is no pose inside.
  std::pair<PathSegment, PathSegment> halves(const PathSegment& segment) const;

  /// Computes the motions to sweep, end to end: split() of one step or a fraction of it, mergedMotion() of several
  /// steps.
  /// @param max_rotation    of a motion within one step [rad]
  /// @param[out] motions_M  overwritten
  void motions_M(const PathSegment& segment, double max_rotation, std::vector<Motion>& motions_M) const;

  /// Returns the pose at the end of the segment. The covariance of its error is 0 at the measured pose and linear in time
  /// between two poses.
  UncertainPose end_M(const PathSegment& segment) const { return at(segment.to, segment.last - 1); }

  /// Returns a box that holds every tool point throughout the segment, if no pose errs by more than `deviations`
  /// standard deviations.
  /// @param margin  the tool is grown by this [m], >= 0
  Eigen::AlignedBox3d reach_M(const PathSegment& segment, double deviations, double margin) const;

  /// Returns what bounds the volumes of a segment of one step or of a fraction of it.
  /// @param margin  the tool is grown by this [m], >= 0
  UncertainStep uncertainStep(const PathSegment& segment, double margin) const;

 private:
  UncertainPose at(Duration time, size_t first) const;
  void begin(const Tool& tool);
  double shareOf(Duration time, size_t first) const;
  RelativeMotion part(const PathSegment& segment) const;

  Eigen::AlignedBox3d tool_T_;
  double tool_radius_ = 0.0;
  Path path_M_;
  std::vector<Matrix6d> covariances_M_;  // at the points of path_M_
  std::vector<double> deviations_;       // from a Motion, before each point of path_M_
  std::vector<RelativeMotion> steps_W_;  // between them, in a frame that moves; empty: it rests
};

/// Finds where the sweeps along a predicted path end: numbers of poses, counted as by PathInMesh; the last sweep ends
/// with the path. In the reflex interval every pose ends a sweep. The steps after it are shared evenly among about
/// `considered_sweeps` sweeps, but no two steps are joined that turn by more than 1.5 rad together.
/// @param X_WT               where the path begins
/// @param reflex_sweeps      number of poses in the reflex interval
/// @param considered_sweeps  >= 1
/// @param[out] ends          overwritten
void findSweepEnds(const Eigen::Isometry3d& X_WT, const PredictedPath& path, size_t reflex_sweeps,
                   size_t considered_sweeps, std::vector<size_t>& ends);

}  // namespace sweep_guard_core
