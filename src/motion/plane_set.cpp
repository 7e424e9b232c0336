#include "sweep_guard/motion/plane_set.h"

#include <algorithm>

#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

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

void requireUsable(const PlaneSet& planes) {
  requireUsable(planes.uncovered);
  for (const SeparatingPlane& plane : planes.planes) {
    requireUsable(FacingBall{plane.normal_W, plane.point_W, plane.gap, plane.surface_speed});
  }
}

void requireUsable(const ToolBalls& tool) {
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
