#include "guard/rigid_shape.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

// Returns the rotation by which one set of points about its mean becomes most nearly another one, from the sum of their
// outer products.
Eigen::Matrix3d rotationOf(const Eigen::Matrix3d& products) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Eigen::Vector3d(1.0, 1.0, handedness).asDiagonal() * svd.matrixV().transpose();
}

// Reads the vertices where they are: it runs at each update of a payload.
template <typename PositionOf>
RigidFit fit(const TriangleMesh& mesh_M, const PositionOf& after_M) {
  RigidFit fit{{}, std::numeric_limits<double>::infinity()};
  Eigen::Vector3d mean_before_M = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_after_M = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < mesh_M.vertexCount(); ++i) {
    mean_before_M += mesh_M.vertex(i);
    mean_after_M += after_M(i);
  }
  mean_before_M /= static_cast<double>(mesh_M.vertexCount());
  mean_after_M /= static_cast<double>(mesh_M.vertexCount());
  if (!mean_after_M.allFinite()) return fit;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < mesh_M.vertexCount(); ++i)
    products += (after_M(i) - mean_after_M) * (mesh_M.vertex(i) - mean_before_M).transpose();
  fit.X_MM.linear() = rotationOf(products);
  fit.X_MM.translation() = mean_after_M - fit.X_MM.linear() * mean_before_M;
  double farthest = 0.0;
  for (size_t i = 0; i < mesh_M.vertexCount(); ++i)
    farthest = std::max(farthest, (after_M(i) - fit.X_MM * mesh_M.vertex(i)).squaredNorm());
  fit.deviation = std::sqrt(farthest);
  return fit;
}

}  // namespace

RigidFit rigidFit(const TriangleMesh& mesh_M, const std::vector<float>& positions_M) {
  assert(positions_M.size() == 3 * mesh_M.vertexCount());
  return fit(mesh_M, [&](size_t i) -> Eigen::Vector3d {
    return Eigen::Map<const Eigen::Vector3f>(&positions_M[3 * i]).cast<double>();
  });
}

RigidFit rigidFit(const TriangleMesh& mesh_M, const TriangleMesh& moved_M) {
  assert(moved_M.vertexCount() == mesh_M.vertexCount());
  return fit(mesh_M, [&](size_t i) { return moved_M.vertex(i); });
}

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b) {
  return &a.triangles() == &b.triangles() || (a.vertexCount() == b.vertexCount() && a.triangles() == b.triangles());
}

}  // namespace sweep_guard_core
