#include "geometry/qhull.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Tetrahedra = std::vector<std::array<std::uint32_t, 4>>;

Eigen::Matrix3Xd cubeWithPoints(Random& random, int count) {
  Eigen::Matrix3Xd points(3, 8 + count);
  for (int i = 0; i < 8; ++i) points.col(i) = Eigen::Vector3d(i & 1, (i >> 1) & 1, i >> 2);
  for (int i = 0; i < count; ++i) {
    points.col(8 + i) = Eigen::Vector3d::Constant(0.5) + random.inBox(Eigen::Vector3d::Constant(0.49));
  }
  return points;
}

Eigen::Matrix3d edges(const Eigen::Matrix3Xd& points, const std::array<std::uint32_t, 4>& corners) {
  Eigen::Matrix3d edges;
  for (size_t i = 1; i < 4; ++i) {
    edges.col(static_cast<Eigen::Index>(i) - 1) = points.col(corners[i]) - points.col(corners[0]);
  }
  return edges;
}

TEST(DelaunayTest, TetrahedraFillTheHull) {
  Random random(3);
  const Eigen::Matrix3Xd points = cubeWithPoints(random, 200);
  double volume = 0.0;
  for (const auto& corners : delaunayTetrahedra(points)) volume += std::abs(edges(points, corners).determinant()) / 6.0;
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(DelaunayTest, NoPointIsInASphereThroughTheCornersOfATetrahedron) {
  Random random(4);
  const Eigen::Matrix3Xd points = cubeWithPoints(random, 200);
  const Tetrahedra tetrahedra = delaunayTetrahedra(points);
  ASSERT_GT(tetrahedra.size(), 500U);
  for (const auto& corners : tetrahedra) {
    const Eigen::Matrix3d sides = edges(points, corners);
    if (std::abs(sides.determinant()) < 1e-9) continue;
    const Eigen::Vector3d center =
        sides.transpose().inverse() * (0.5 * sides.colwise().squaredNorm().transpose());  // from the first corner
    const auto distances = (points.colwise() - (points.col(corners[0]) + center)).colwise().norm();
    EXPECT_GT(distances.minCoeff(), center.norm() * (1.0 - 1e-9));
  }
}

TEST(DelaunayTest, PointsInAPlaneHaveNoTetrahedra) {
  Random random(5);
  Eigen::Matrix3Xd points = cubeWithPoints(random, 20);
  points.row(2).setZero();
  EXPECT_TRUE(delaunayTetrahedra(points).empty());
  EXPECT_TRUE(delaunayTetrahedra(points.leftCols(3)).empty());
}

}  // namespace
}  // namespace sweep_guard_core
