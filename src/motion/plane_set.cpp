#include "sweep_guard/motion/plane_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {
namespace {

constexpr double kBeyond = 1e-6;  // of a plane [m]: a pose that was limited may lie in it

double leastGap(const SeparatingPlane& plane, const std::vector<ToolBall>& balls_T, const Eigen::Isometry3d& X_WT) {
  double least = std::numeric_limits<double>::infinity();
  for (const ToolBall& ball : balls_T)
    least = std::min(least, plane.normal_W.dot(X_WT * ball.center_T - plane.point_W) - ball.radius);
  return least;
}

}  // namespace

double radiusAbout(const Eigen::Vector3d& p_T, const ToolBalls& tool) {
  double radius = 0.0;
  for (const std::vector<ToolBall>& balls : tool.pieces) {
    for (const ToolBall& ball : balls) radius = std::max(radius, (ball.center_T - p_T).norm() + ball.radius);
  }
  return radius;
}

bool belongsTo(const PlaneSet& planes, const ToolBalls& tool) {
  return planes.tool_revision == tool.revision &&
         std::all_of(planes.planes.begin(), planes.planes.end(),
                     [&](const SeparatingPlane& plane) { return plane.piece < tool.pieces.size(); });
}

double largestDisplacement(const Eigen::Isometry3d& from_WT, const Eigen::Isometry3d& to_WT, double radius) {
  const double angle = Eigen::AngleAxisd(from_WT.linear().transpose() * to_WT.linear()).angle();
  return (from_WT.translation() - to_WT.translation()).norm() + radius * angle;
}

bool passesASurface(const PlaneSet& planes, const ToolBalls& tool, const Eigen::Isometry3d& from_WT,
                    const Eigen::Isometry3d& to_WT) {
  const double radius = radiusAbout(Eigen::Vector3d::Zero(), tool);
  const auto reaches = [&](const Eigen::Isometry3d& X_WT) {
    return largestDisplacement(planes.X_WT, X_WT, radius) > planes.uncovered.distance + kBeyond;
  };
  if (reaches(to_WT) && !reaches(from_WT)) return true;
  return std::any_of(planes.planes.begin(), planes.planes.end(), [&](const SeparatingPlane& plane) {
    const std::vector<ToolBall>& balls_T = tool.pieces[plane.piece];
    return leastGap(plane, balls_T, to_WT) < -kBeyond && leastGap(plane, balls_T, from_WT) >= 0.0;
  });
}

void requireUsable(const PlaneSet& planes) {
  requireUsable(planes.uncovered);
  const auto finite = [](double position) { return std::isfinite(position); };
  if (planes.joints.size() != planes.positions.size() ||
      !std::all_of(planes.positions.begin(), planes.positions.end(), finite))
    throw InvalidInput("separating planes refused: not one finite position of each joint");
  for (const SeparatingPlane& plane : planes.planes) {
    requireUsable(FacingBall{plane.normal_W, plane.point_W, plane.gap, plane.surface_speed});
  }
}

void requireUsable(const ToolBalls& tool) {
  if (!tool.frames.empty() && tool.frames.size() != tool.pieces.size())
    throw InvalidInput("balls of the tool refused: not one frame of each piece");
  for (const std::vector<ToolBall>& balls : tool.pieces) {
    if (balls.empty()) throw InvalidInput("balls of the tool refused: a piece has none");
    for (const ToolBall& ball : balls) {
      const bool usable =
          (ball.center_T.array().abs() <= kMaxCoordinate).all() && ball.radius >= 0.0 && ball.radius <= kMaxCoordinate;
      if (!usable) throw InvalidInput("balls of the tool refused: a center or radius is not finite or out of range");
    }
  }
}

}  // namespace sweep_guard_core
