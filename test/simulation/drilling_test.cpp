#include "simulation/drilling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kStep = 0.01;  // [s]

std::vector<Eigen::Vector3d> holes() { return {{0, 0, 0.5}, {0.06, 0, 0.48}, {0, 0.06, 0.49}}; }

Drilling drilling() { return Drilling(holes(), {}); }

TEST(DrillingTest, PlungesTenMillimetersIntoEveryHole) {
  const Drilling motion = drilling();
  for (const Eigen::Vector3d& hole : holes()) {
    const Eigen::Vector3d bottom = hole - 0.010 * Eigen::Vector3d::UnitZ();
    double nearest = 1.0;
    for (double t = 0.0; t < motion.duration(); t += kStep)
      nearest = std::min(nearest, (motion.pose(t).translation() - bottom).norm());
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST(DrillingTest, PointsDownWhileItIsInTheHole) {
  const Drilling motion = drilling();
  for (double t = 0.0; t < motion.duration(); t += kStep) {
    const Eigen::Isometry3d X_WT = motion.pose(t);
    if (X_WT.translation().z() > 0.475) continue;
    EXPECT_NEAR(X_WT.linear().col(2).z(), -1.0, 1e-9) << t;
  }
}

TEST(DrillingTest, StaysClearOfTheSurfaceWhileItTravels) {
  const Drilling::Options options;
  const Drilling motion = drilling();
  for (double t = 0.0; t < options.travel_time; t += kStep) EXPECT_GT(motion.pose(t).translation().z(), 0.54) << t;
}

TEST(DrillingTest, MovesAllSixDegreesOfFreedomAboveTheWorkpiece) {
  const Drilling motion = drilling();
  const Eigen::Isometry3d X_WT0 = motion.pose(0.0);
  Eigen::Matrix<double, 6, 1> travel = Eigen::Matrix<double, 6, 1>::Zero();
  for (double t = 0.0; t < 2.0; t += kStep) {
    const Eigen::Isometry3d X_TT = X_WT0.inverse() * motion.pose(t);
    const Eigen::AngleAxisd turn(X_TT.linear());
    travel.head<3>() = travel.head<3>().cwiseMax(X_TT.translation().cwiseAbs());
    travel.tail<3>() = travel.tail<3>().cwiseMax((turn.angle() * turn.axis()).cwiseAbs());
  }
  EXPECT_GT(travel.head<3>().minCoeff(), 0.005);
  EXPECT_GT(travel.tail<3>().minCoeff(), 0.05);
}

TEST(DrillingTest, NeverJumps) {
  const Drilling motion = drilling();
  for (double t = 0.0; t < 2.5 * motion.duration(); t += kStep) {
    const Eigen::Isometry3d X_TT = motion.pose(t).inverse() * motion.pose(t + kStep);
    EXPECT_LT(X_TT.translation().norm(), 0.004) << t;
    EXPECT_LT(Eigen::AngleAxisd(X_TT.linear()).angle(), 0.03) << t;
  }
}

TEST(DrillingTest, IsRigidAtAllTimes) {
  const Drilling motion = drilling();
  for (double t = 0.0; t < motion.duration(); t += 10 * kStep) {
    EXPECT_TRUE((motion.pose(t).linear() * motion.pose(t).linear().transpose()).isIdentity(1e-12));
    EXPECT_NEAR(motion.pose(t).linear().determinant(), 1.0, 1e-12);
  }
}

TEST(DrillingTest, RefusesNoHoleAndOptionsOutOfRange) {
  EXPECT_THROW(Drilling({}, {}), sweep_guard_core::InvalidInput);
  Drilling::Options options;
  options.travel_time = 0.0;
  EXPECT_THROW(Drilling(holes(), options), sweep_guard_core::InvalidInput);
}

// A roof with its ridge along y at x = 0 and 45 degree sides: the point at x = -1 lies a radius below the ridge.
TEST(HolesAroundTest, LeavesOutPointsThatAreMissingOrFarBelow) {
  const sweep_guard_core::TriangleMesh roof({{0, 0, 3}, {0, 3, 2.9}, {-3, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  const auto found = holesAround(roof, /*radius=*/0.5, /*count=*/4);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].isApprox(Eigen::Vector3d(0, 0, 3)));
  EXPECT_NEAR(found[1].y(), 0.5, 1e-9);
}

// Two triangles over the unit triangle, the upper one slanted from z = 1 to z = 3 along x, and a loose vertex above both.
sweep_guard_core::TriangleMesh twoTriangles() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 3}, {0, 1, 1}, {0, 0, 9}}, {{0, 1, 2}, {3, 4, 5}}};
}

TEST(TopSurfaceTest, GivesTheHeightOfTheUpperTriangle) {
  EXPECT_NEAR(surfaceHeight(twoTriangles(), 0.25, 0.25).value(), 1.5, 1e-6);
  EXPECT_NEAR(surfaceHeight(twoTriangles(), 1.0, 0.0).value(), 3.0, 1e-6);
}

TEST(TopSurfaceTest, HasNoHeightBesideTheWorkpiece) { EXPECT_FALSE(surfaceHeight(twoTriangles(), 0.6, 0.6)); }

TEST(TopSurfaceTest, IsHighestAtAVertexOfATriangle) {
  EXPECT_TRUE(highestPoint(twoTriangles()).isApprox(Eigen::Vector3d(1, 0, 3)));
}

}  // namespace
}  // namespace sweep_guard_simulation
