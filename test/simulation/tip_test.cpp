#include "simulation/tip.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using Eigen::Vector3d;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::Tool;

ConvexShape boxAt(const Vector3d& center, const Vector3d& half_extents) {
  return ConvexShape::box(half_extents).placed(Eigen::Isometry3d(Eigen::Translation3d(center)));
}

TEST(TipTest, IsTheOriginForACylinder) {
  EXPECT_LT(tipOf(Tool::cylinder(0.01, 0.15)).norm(), 1e-9);
  EXPECT_NEAR(radialExtent(Tool::cylinder(0.01, 0.15)), std::sqrt(2.0) * 0.01, 1e-6);
}

TEST(TipTest, IsTheMiddleOfTheFaceOfThePieceInFront) {
  const Tool tool(
      {{"palm", boxAt({0, 0, 0}, {0.1, 0.1, 0.1})}, {"finger", boxAt({0.05, -0.02, 0.2}, {0.01, 0.02, 0.03})}});
  EXPECT_LT((tipOf(tool) - Vector3d(0.05, -0.02, 0.23)).norm(), 1e-6);
  EXPECT_NEAR(radialExtent(tool), std::hypot(0.15, 0.12), 1e-6);
}

TEST(TipTest, IsTheTopOfABall) {
  const Tool tool({{"ball", ConvexShape::sphere(0.5)}});
  EXPECT_LT((tipOf(tool) - Vector3d(0, 0, 0.5)).norm(), 1e-3);
}

TEST(TipTest, TheFrontIsWhereTheToolReachesFarthest) {
  const Tool tool({{"left", boxAt({-0.2, 0, 0}, {0.1, 0.1, 0.1})}, {"right", boxAt({0.2, 0.05, 0}, {0.1, 0.1, 0.1})}});
  EXPECT_LT((frontOf(tool, Vector3d::UnitX()) - Vector3d(0.3, 0.05, 0)).norm(), 1e-6);
  EXPECT_LT((frontOf(tool, -Vector3d::UnitX()) - Vector3d(-0.3, 0, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace sweep_guard_simulation
