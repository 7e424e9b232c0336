#include "guard/rigid_shape.h"

#include <cassert>
#include <limits>

namespace sweep_guard_core {
namespace {

Eigen::Matrix3Xd verticesOf(const TriangleMesh& mesh_M) {
  Eigen::Matrix3Xd vertices_M(3, static_cast<Eigen::Index>(mesh_M.vertexCount()));
  for (Eigen::Index i = 0; i < vertices_M.cols(); ++i) vertices_M.col(i) = mesh_M.vertex(static_cast<size_t>(i));
  return vertices_M;
}

RigidFit fit(const Eigen::Matrix3Xd& before_M, const Eigen::Matrix3Xd& after_M) {
  assert(before_M.cols() == after_M.cols());
  RigidFit fit{{}, std::numeric_limits<double>::infinity()};
  if (!after_M.allFinite()) return fit;
  fit.X_MM.matrix() = Eigen::umeyama(before_M, after_M, /*with_scaling=*/false);
  const Eigen::Matrix3Xd moved_M = (fit.X_MM.linear() * before_M).colwise() + fit.X_MM.translation();
  fit.deviation = (after_M - moved_M).colwise().norm().maxCoeff();
  return fit;
}

}  // namespace

RigidFit rigidFit(const TriangleMesh& mesh_M, const std::vector<float>& positions_M) {
  assert(positions_M.size() == 3 * mesh_M.vertexCount());
  const auto count = static_cast<Eigen::Index>(mesh_M.vertexCount());
  return fit(verticesOf(mesh_M), Eigen::Map<const Eigen::Matrix3Xf>(positions_M.data(), 3, count).cast<double>());
}

RigidFit rigidFit(const TriangleMesh& mesh_M, const TriangleMesh& moved_M) {
  return fit(verticesOf(mesh_M), verticesOf(moved_M));
}

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b) {
  return &a.triangles() == &b.triangles() || (a.vertexCount() == b.vertexCount() && a.triangles() == b.triangles());
}

}  // namespace sweep_guard_core
