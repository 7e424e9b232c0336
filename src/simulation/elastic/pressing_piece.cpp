#include "simulation/elastic/pressing_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sweep_guard_simulation {

using Eigen::Vector3d;
using sweep_guard_core::TriangleMesh;

namespace {

constexpr double kPointsPerRadius = 4.0;  // of the piece, along an edge of a triangle
constexpr int kMaxPoints = 20;            // along an edge

using Corners = std::array<Vector3d, 3>;

struct LayerSpring {
  double area = 0.0;    // [m^2]
  double volume = 0.0;  // [m^3]
};

double reachOf(const sweep_guard_core::PiecePolytope& polytope) {
  double reach = 0.0;
  for (const auto& face : polytope.faces()) {
    for (const Vector3d& corner : face) reach = std::max(reach, corner.norm());
  }
  return reach;
}

bool near(const Corners& corners, double radius) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::min({corners[0][axis], corners[1][axis], corners[2][axis]}) > radius) return false;
    if (std::max({corners[0][axis], corners[1][axis], corners[2][axis]}) < -radius) return false;
  }
  return true;
}

int pointsAlong(const Corners& corners, double spacing) {
  const double longest =
      std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(), (corners[0] - corners[2]).norm()});
  return std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, kMaxPoints);
}

// Calls visit(weights of the corners) for the middles of count^2 equal parts of a triangle.
template <typename Visit>
void forPartsOfTriangle(int count, const Visit& visit) {
  for (int i = 0; i < count; ++i) {
    for (int j = 0; i + j < count; ++j) {
      visit(Vector3d(i + 1.0 / 3, j + 1.0 / 3, count - i - j - 2.0 / 3) / count);
      if (i + j + 1 < count) visit(Vector3d(i + 2.0 / 3, j + 2.0 / 3, count - i - j - 4.0 / 3) / count);
    }
  }
}

}  // namespace

PressingPiece::PressingPiece(const sweep_guard_core::ConvexShape& shape_T, const sweep_guard_core::ForceLaw& law)
    : finder_(shape_T),
      polytope_(shape_T),
      radius_(reachOf(polytope_)),
      spacing_(shape_T.radius() / kPointsPerRadius),
      law_(law) {
  law_.damping = 0.0;
}

void PressingPiece::press(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT, std::vector<Pressure>& pressures) {
  const sweep_guard_core::Interpenetration found = finder_.find(mesh_M, X_MT);
  const double force = interactionForce(found, Vector3d::Zero(), law_).force_T.norm();
  if (!(force > 0.0)) return;
  const Vector3d outward_T = found.area_T.normalized();
  const Eigen::Isometry3d X_TM = X_MT.inverse();
  std::map<std::uint32_t, LayerSpring> springs;
  double volume = 0.0;
  for (const auto& triangle : mesh_M.triangles()) {
    Corners corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = X_TM * mesh_M.vertex(triangle[i]) - polytope_.center_T();
    if (!near(corners, radius_)) continue;
    const double facing = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(outward_T);
    const int count = pointsAlong(corners, spacing_);
    const double area = std::abs(facing) / (count * count);
    forPartsOfTriangle(count, [&](const Vector3d& weights) {
      const Vector3d p = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
      const double below = depth(p, outward_T);
      if (!(below > 0.0)) return;
      volume += area * below;
      for (size_t i = 0; i < 3; ++i) {
        LayerSpring& spring = springs[triangle[i]];
        spring.area += weights[static_cast<Eigen::Index>(i)] * area;
        spring.volume += weights[static_cast<Eigen::Index>(i)] * area * below;
      }
    });
  }
  for (const auto& [vertex, spring] : springs) {
    if (!(spring.volume > 0.0)) continue;
    pressures.push_back(
        {vertex, X_MT.linear() * outward_T, force * spring.volume / volume, force / volume * spring.area});
  }
}

// How far a point inside the piece is from where it leaves the piece against `outward`.
double PressingPiece::depth(const Vector3d& p_T, const Vector3d& outward_T) const {
  double depth = std::numeric_limits<double>::infinity();
  for (const sweep_guard_core::HalfSpace& half_space : polytope_.halfSpaces()) {
    const double distance = -half_space.signedDistance(p_T);
    if (!(distance > 0.0)) return 0.0;
    const double leaving = -half_space.normal().dot(outward_T);
    if (leaving > 0.0) depth = std::min(depth, distance / leaving);
  }
  return depth;
}

}  // namespace sweep_guard_simulation
