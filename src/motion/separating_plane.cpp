#include "sweep_guard/motion/separating_plane.h"

#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr int kSides = 16;
constexpr double kPlacedRounding =
    0x1p-21;  // of vertices to float32, each time a shape is placed, in radii of the mesh
constexpr double kPi = 3.14159265358979323846;

std::vector<ToolBall> prismAround(const ConvexShape& shape_T, const ConvexShape::Cylinder& cylinder) {
  const double radius = cylinder.radius / std::cos(kPi / kSides);
  std::vector<ToolBall> balls;
  for (const double z : {0.0, -cylinder.length}) {
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * kPi * i / kSides;
      const Eigen::Vector3d corner_S(radius * std::cos(angle), radius * std::sin(angle), z);
      balls.push_back({shape_T.X_TS() * corner_S, shape_T.padding()});
    }
  }
  return balls;
}

}  // namespace

std::vector<ToolBall> enclosingBalls(const ConvexShape& shape_T) {
  if (const auto* const cylinder = shape_T.asCylinder()) return prismAround(shape_T, *cylinder);
  if (shape_T.isBall()) return {{shape_T.coreSupportPoint(Eigen::Vector3d::UnitX()), shape_T.padding()}};
  const TriangleMesh& mesh_T = shape_T.mesh_T();
  std::vector<ToolBall> balls;
  for (size_t i = 0; i < mesh_T.vertexCount(); ++i) {
    balls.push_back({mesh_T.vertex(i), shape_T.padding() + kPlacedRounding * mesh_T.radius()});
  }
  return balls;
}

void addFacingBalls(const SeparatingPlane& plane, const std::vector<ToolBall>& balls_T, const Eigen::Isometry3d& X_WT,
                    std::vector<FacingBall>& facing) {
  const double origin = plane.normal_W.dot(X_WT.translation() - plane.point_W);
  for (const ToolBall& ball : balls_T) {
    const Eigen::Vector3d center_W = X_WT.linear() * ball.center_T;
    const double gap = origin + plane.normal_W.dot(center_W) - ball.radius;
    facing.push_back({plane.normal_W, center_W, gap, plane.surface_speed});
  }
}

}  // namespace sweep_guard_core
