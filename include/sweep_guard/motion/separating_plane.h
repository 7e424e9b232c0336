#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// A plane that a surface lies wholly behind and one convex piece of the tool lies in front of, when both were last
/// swept. In the fixed frame W.
struct SeparatingPlane {
  size_t piece;              ///< index into Tool::pieces(); those of several bodies are counted through
  Eigen::Vector3d normal_W;  ///< unit, from the surface to the tool
  Eigen::Vector3d point_W;   ///< a point of the plane [m]
  double gap;                ///< distance of the piece from the plane [m]; negative: the piece reaches through it
  double surface_speed;      ///< speed of the surface's fastest point along normal_W [m/s]; > 0: to the tool
};

/// A ball fixed to the tool. A convex piece lies in the convex hull of some balls, and as the tool moves, none of its
/// points comes nearer to a plane than the nearest ball.
struct ToolBall {
  Eigen::Vector3d center_T;  ///< [m]
  double radius;             ///< [m], >= 0
};

/// Returns balls whose convex hull contains a body: the corners of a hull or a box, the center of a sphere, and for a
/// cylinder the corners of a prism around it with 16 sides, which is 2 % wider.
std::vector<ToolBall> enclosingBalls(const ConvexShape& shape_T);

/// What limits one ball of the tool before one plane, at the newest pose of the tool.
struct FacingBall {
  Eigen::Vector3d normal_W;  ///< of the plane: unit, from the surface to the tool
  Eigen::Vector3d center_W;  ///< of the ball, from the origin of the tool frame, along the axes of W [m]
  double gap;                ///< distance of the ball from the plane [m]; negative: it reaches through the plane
  double surface_speed;      ///< as of the plane [m/s]
};

/// Carries a plane by a newer pose of the tool: adds what limits the balls of its piece there. The surface is where it
/// was: its speed must be paid by BrakingLimits::reaction_time.
/// @param balls_T     of the plane's piece
/// @param[out] facing  one for each ball is added
void addFacingBalls(const SeparatingPlane& plane, const std::vector<ToolBall>& balls_T, const Eigen::Isometry3d& X_WT,
                    std::vector<FacingBall>& facing);

}  // namespace sweep_guard_core
