#include "simulation/top_surface.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace sweep_guard_simulation {

namespace {

std::optional<double> heightOver(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                 const Eigen::Vector2d& point) {
  Eigen::Matrix2d sides;
  sides << (b - a).head<2>(), (c - a).head<2>();
  if (sides.determinant() == 0.0) return std::nullopt;
  const Eigen::Vector2d weights = sides.inverse() * (point - a.head<2>());
  if (weights.minCoeff() < 0.0 || weights.sum() > 1.0) return std::nullopt;
  return a.z() + weights.x() * (b - a).z() + weights.y() * (c - a).z();
}

}  // namespace

TopSurface::TopSurface(sweep_guard_core::TriangleMesh mesh_W)
    : mesh_W_(std::move(mesh_W)), highest_W_(mesh_W_.vertex(mesh_W_.triangles().front().front())) {
  for (const sweep_guard_core::Triangle& triangle : mesh_W_.triangles()) {
    for (const std::uint32_t index : triangle) {
      if (mesh_W_.vertex(index).z() > highest_W_.z()) highest_W_ = mesh_W_.vertex(index);
    }
  }
}

std::optional<double> TopSurface::height(double x, double y) const {
  std::optional<double> highest;
  for (const auto& [a, b, c] : mesh_W_.triangles()) {
    const std::optional<double> height = heightOver(mesh_W_.vertex(a), mesh_W_.vertex(b), mesh_W_.vertex(c), {x, y});
    if (height) highest = std::max(highest.value_or(*height), *height);
  }
  return highest;
}

}  // namespace sweep_guard_simulation
