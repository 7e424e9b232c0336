#include "simulation/drilling.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

// Two triangles over the unit triangle, the upper one slanted from z = 1 to z = 3 along x, and a loose vertex above both.
TopSurface twoTriangles() {
  return TopSurface(sweep_guard_core::TriangleMesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 3}, {0, 1, 1}, {0, 0, 9}}, {{0, 1, 2}, {3, 4, 5}}));
}

TEST(TopSurfaceTest, GivesTheHeightOfTheUpperTriangle) {
  EXPECT_NEAR(twoTriangles().height(0.25, 0.25).value(), 1.5, 1e-6);
  EXPECT_NEAR(twoTriangles().height(1.0, 0.0).value(), 3.0, 1e-6);
}

TEST(TopSurfaceTest, HasNoHeightBesideTheWorkpiece) { EXPECT_FALSE(twoTriangles().height(0.6, 0.6)); }

TEST(TopSurfaceTest, IsHighestAtAVertexOfATriangle) {
  EXPECT_TRUE(twoTriangles().highestPoint().isApprox(Eigen::Vector3d(1, 0, 3)));
}

}  // namespace
}  // namespace sweep_guard_simulation
