#include "sweep_guard/guard/moving_mesh.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard {
namespace {

template <typename Take>
void eachWay(const TriangleMesh& from_M, const TriangleMesh& to_M, const Take& take) {
  for (size_t i = 0; i < to_M.vertexCount(); ++i) take(to_M.vertex(i) - from_M.vertex(i));
}

std::array<Eigen::Vector3d, 3> corners(const TriangleMesh& mesh, const Triangle& triangle) {
  return {mesh.vertex(triangle[0]), mesh.vertex(triangle[1]), mesh.vertex(triangle[2])};
}

}  // namespace

MovingMesh::MovingMesh(const TriangleMesh& mesh_M, const TriangleMesh& before_M, double strayed) : mesh_M_(mesh_M) {
  if (farthestWay(before_M, mesh_M) == 0.0 && strayed == 0.0) return;
  before_M_ = &before_M;
  eachWay(before_M, mesh_M, [&](const Eigen::Vector3d& way) { drift_M_ += way; });
  drift_M_ /= static_cast<double>(mesh_M.vertexCount());
  double apart = 0.0;
  eachWay(before_M, mesh_M, [&](const Eigen::Vector3d& way) { apart = std::max(apart, (way - drift_M_).norm()); });
  uncertainty_ = strayed + std::max(mesh_M.rounding(), before_M.rounding());
  spread_ = apart + uncertainty_;
}

MovingTriangle MovingMesh::triangle(std::uint32_t index) const {
  const Triangle& triangle = mesh_M_.triangles()[index];
  const auto now_M = corners(mesh_M_, triangle);
  return {moved() ? corners(*before_M_, triangle) : now_M, now_M};
}

// The farthest from the straight way that a path of this length reaches, is the height of an isosceles triangle on it.
double strayed(double way, double straight) {
  return 0.5 * std::sqrt(std::max(0.0, (way - straight) * (way + straight)));
}

double farthestWay(const TriangleMesh& from_M, const TriangleMesh& to_M) {
  double farthest = 0.0;
  eachWay(from_M, to_M, [&](const Eigen::Vector3d& way) { farthest = std::max(farthest, way.squaredNorm()); });
  return std::sqrt(farthest);
}

double leastWay(const TriangleMesh& from_M, const TriangleMesh& to_M) {
  double least = kMaxCoordinate * kMaxCoordinate;
  eachWay(from_M, to_M, [&](const Eigen::Vector3d& way) { least = std::min(least, way.squaredNorm()); });
  return std::sqrt(least);
}

}  // namespace sweep_guard
