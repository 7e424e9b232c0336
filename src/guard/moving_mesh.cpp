#include "guard/moving_mesh.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core {
namespace {

std::array<Eigen::Vector3d, 3> corners(const TriangleMesh& mesh, const Triangle& triangle) {
  return {mesh.vertex(triangle[0]), mesh.vertex(triangle[1]), mesh.vertex(triangle[2])};
}

}  // namespace

MovingMesh::MovingMesh(const TriangleMesh& mesh_M, const TriangleMesh& before_M, const Displacements& displacements,
                       double path_deviation)
    : mesh_M_(mesh_M) {
  if (!displacements.any() && path_deviation == 0.0) return;
  before_M_ = &before_M;
  translation_M_ = displacements.box_M().center();
  uncertainty_ = path_deviation + std::max(mesh_M.margin(), before_M.margin());
  spread_ = 0.5 * displacements.box_M().diagonal().norm() + uncertainty_;
}

MovingMesh MovingMesh::grid(const TriangleMesh& mesh_M) {
  MovingMesh mesh(mesh_M);
  mesh.is_grid_ = true;
  return mesh;
}

MovingTriangle MovingMesh::triangle(std::uint32_t index) const {
  const Triangle& triangle = mesh_M_.triangles()[index];
  if (before_M_ != nullptr) return {corners(*before_M_, triangle), corners(mesh_M_, triangle)};
  return untranslated(index);
}

MovingTriangle MovingMesh::untranslated(std::uint32_t index) const {
  const Triangle& triangle = mesh_M_.triangles()[index];
  const auto now_M = corners(mesh_M_, triangle);
  if (!is_grid_) return {now_M, now_M};
  const auto& [a, b, c] = triangle;
  return {{mesh_M_.vertexBefore(a), mesh_M_.vertexBefore(b), mesh_M_.vertexBefore(c)}, now_M};
}

MovingMesh movingMesh(const Workpiece& now, const Workpiece& before, const Displacements& displacements) {
  if (&now == &before) return now.mesh_M;
  const bool skipped = now.updates > before.updates + 1;
  const double path_length = now.path_length - before.path_length;
  const double deviation = skipped ? pathDeviation(path_length, displacements.lowerBound()) : 0.0;
  return {now.mesh_M, before.mesh_M, displacements, deviation};
}

// A path of this length deviates most if it forms an isosceles triangle with the straight path.
double pathDeviation(double path_length, double displacement) {
  return 0.5 * std::sqrt(std::max(0.0, (path_length - displacement) * (path_length + displacement)));
}

}  // namespace sweep_guard_core
