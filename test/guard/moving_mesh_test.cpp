#include "guard/moving_mesh.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

TriangleMesh triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return TriangleMesh({a, b, c}, {{0, 1, 2}});
}

const TriangleMesh kFlat = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

TEST(MovingMeshTest, ThatRestsHasNotMoved) {
  EXPECT_FALSE(MovingMesh(kFlat).moved());
  EXPECT_FALSE(MovingMesh(kFlat, kFlat, {kFlat, kFlat}, 0.0).moved());
  EXPECT_EQ(MovingMesh(kFlat).spread(), kFlat.rounding());
}

TEST(MovingMeshTest, ItsPaddingIsPartOfSpreadAndUncertaintyWhetherItMovesOrRests) {
  TriangleMesh up = triangle({0, 0, 2}, {1, 0, 2}, {0, 1, 2});
  up.pad(0.5);
  EXPECT_EQ(MovingMesh(up).spread(), 0.5);
  EXPECT_EQ(MovingMesh(up).uncertainty(), 0.5);
  const MovingMesh mesh(up, kFlat, {kFlat, up}, 0.25);
  EXPECT_NEAR(mesh.spread(), 0.75, 1e-6);
  EXPECT_NEAR(mesh.uncertainty(), 0.75, 1e-6);
}

TEST(MovingMeshTest, ThatMovesAsAWholeIsTranslatedWithoutSpread) {
  const TriangleMesh up = triangle({0, 0, 2}, {1, 0, 2}, {0, 1, 2});
  const MovingMesh mesh(up, kFlat, {kFlat, up}, 0.0);
  EXPECT_TRUE(mesh.moved());
  EXPECT_TRUE(mesh.translation_M().isApprox(Eigen::Vector3d(0, 0, 2)));
  EXPECT_NEAR(mesh.spread(), 0.0, 1e-7);
}

TEST(MovingMeshTest, SpreadsAsFarAsAVertexLeavesTheTranslation) {
  const TriangleMesh bent = triangle({0, 0, 3}, {1, 0, 0}, {0, 1, 0});
  const MovingMesh mesh(bent, kFlat, {kFlat, bent}, 0.25);
  EXPECT_TRUE(mesh.translation_M().isApprox(Eigen::Vector3d(0, 0, 1.5)));
  EXPECT_NEAR(mesh.spread(), 1.75, 1e-6);
  EXPECT_NEAR(mesh.uncertainty(), 0.25, 1e-6);
  EXPECT_EQ(mesh.triangle(0).start_M[0], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(mesh.triangle(0).end_M[0], Eigen::Vector3d(0, 0, 3));
}

TEST(MovingMeshTest, HasMovedIfItMayHaveDeviatedAndReturned) {
  EXPECT_TRUE(MovingMesh(kFlat, kFlat, {kFlat, kFlat}, 0.1).moved());
}

// Of all paths of a length between two points, the one over the tip of an isosceles triangle goes farthest aside.
TEST(PathDeviationTest, IsTheHeightOfTheTriangleOverTheStraightPath) {
  EXPECT_DOUBLE_EQ(pathDeviation(5.0, 3.0), 2.0);
  EXPECT_EQ(pathDeviation(3.0, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(pathDeviation(1.0, 0.0), 0.5);
}

}  // namespace
}  // namespace sweep_guard_core
