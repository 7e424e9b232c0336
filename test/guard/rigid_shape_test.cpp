#include "guard/rigid_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

std::vector<float> positionsAt(const TriangleMesh& mesh, const Eigen::Isometry3d& X) {
  std::vector<float> positions;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Eigen::Vector3f p = (X * mesh.vertex(i)).cast<float>();
    positions.insert(positions.end(), p.data(), p.data() + 3);
  }
  return positions;
}

TEST(RigidShapeTest, AnyRigidMotionKeepsTheShape) {
  Random random(1);
  const TriangleMesh hull = wavyHull(12, 18, 0.0);
  const TriangleMesh flat({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d X = random.pose(random.inBox({1.0, 1.0, 1.0}));
    EXPECT_LT(rigidFit(hull, positionsAt(hull, X)).deviation, 1e-6);
    EXPECT_TRUE(rigidFit(hull, positionsAt(hull, X)).X_MM.isApprox(X, 1e-5));
    EXPECT_LT(rigidFit(flat, positionsAt(flat, X)).deviation, 1e-6);
  }
}

TEST(RigidShapeTest, OneVertexThatLeavesItIsFound) {
  Random random(2);
  const TriangleMesh hull = wavyHull(12, 18, 0.0);
  for (int i = 0; i < 100; ++i) {
    std::vector<float> positions = positionsAt(hull, random.pose(random.inBox({1.0, 1.0, 1.0})));
    positions[3 * static_cast<size_t>(random.below(static_cast<int>(hull.vertexCount())))] += 0.01F;
    EXPECT_NEAR(rigidFit(hull, positions).deviation, 0.01, 5e-4);
  }
}

// A mirror keeps all distances.
TEST(RigidShapeTest, AMirroredShapeIsAnother) {
  const TriangleMesh hull = wavyHull(12, 18, 0.0);
  std::vector<float> positions = streamedPositions(hull);
  for (size_t i = 0; i < positions.size(); i += 3) positions[i] = -positions[i];
  EXPECT_GT(rigidFit(hull, positions).deviation, 1e-3);
}

TEST(RigidShapeTest, WhatIsNotFiniteHasNoShape) {
  const TriangleMesh hull = wavyHull(6, 8, 0.0);
  std::vector<float> positions = streamedPositions(hull);
  positions[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(rigidFit(hull, positions).deviation, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace sweep_guard_core
