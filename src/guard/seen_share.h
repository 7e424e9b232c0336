#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "camera/free_space.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Returns 64 points spread over the pieces of a tool, in its frame [m].
std::vector<Eigen::Vector3d> pointsWithin(const Tool& tool);

/// How much of what a tool takes up on its predicted path cameras have seen to be free: in the step of which they have seen the least.
/// Where the tool is now was not to be seen, and does not count; nor does a step in which less than a quarter of the points of a body
/// leave that place. Each point stands for one place in each step. Keeps its buffers.
class SeenShare {
 public:
  /// Begins a path. @returns whether there is a camera
  bool begin(const Workpieces& workpieces, const PoseWithFrames& pose);

  /// Adds the path of a body.
  /// @param points_B  pointsWithin() of the body
  void add(const Tool& body, const std::vector<Eigen::Vector3d>& points_B, const Eigen::Isometry3d& X_WB,
           const PredictedPath& path);

  double share() const { return share_; }  ///< that any camera has seen, 0 to 1; 1 if all stay where they are

 private:
  struct Camera {
    Eigen::Isometry3d X_FW;
    const FreeSpace* space;
  };

  bool isSeen(const Eigen::Vector3d& p_W) const;

  std::vector<Camera> cameras_;
  double share_ = 1.0;
};

}  // namespace sweep_guard_core
