#include "sweep_guard/geometry/convex_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/round_tool.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

TEST(ConvexShapeTest, FillsTheCylinderBehindItsTip) {
  const ConvexShape drill = ConvexShape::cylinder(/*radius=*/0.5, /*length=*/2.0);
  EXPECT_EQ(drill.support(Eigen::Vector3d::UnitZ()), 0.0);
  EXPECT_EQ(drill.support(-Eigen::Vector3d::UnitZ()), 2.0);
  EXPECT_EQ(drill.support(Eigen::Vector3d::UnitX()), 0.5);
  EXPECT_NEAR(drill.support({0.0, 0.6, -0.8}), 0.5 * 0.6 + 2.0 * 0.8, 1e-15);
  EXPECT_NEAR(drill.support({0.0, 0.6, 0.8}), 0.5 * 0.6, 1e-15);
}

TEST(ConvexShapeTest, SupportIsThatOfTheRoundToolSampledDensely) {
  Random random(/*seed=*/1);
  constexpr int kPoints = 720;
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 1.0);
    const Eigen::Vector3d direction = random.direction();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : roundToolPoints_T(tool, kPoints)) farthest = std::max(farthest, direction.dot(p));
    EXPECT_NEAR(tool.support(direction), farthest, 1e-5 * tool.radius() + 1e-15) << "tool " << i;
    EXPECT_GE(tool.support(direction), farthest - 1e-15) << "tool " << i;
  }
}

TEST(ConvexShapeTest, SupportAtAPoseFollowsThePose) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0);
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();
  X_MT.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()).toRotationMatrix();  // z_T along x_M
  X_MT.translation() = Eigen::Vector3d(10, 20, 30);
  EXPECT_NEAR(support(drill, X_MT, Eigen::Vector3d::UnitX()), 10.0, 1e-12);
  EXPECT_NEAR(support(drill, X_MT, -Eigen::Vector3d::UnitX()), -8.0, 1e-12);
  EXPECT_NEAR(support(drill, X_MT, Eigen::Vector3d::UnitZ()), 30.5, 1e-12);

  const Motion motion{X_MT, Eigen::Translation3d(1, 0, 0) * X_MT};
  EXPECT_NEAR(support(drill, motion, Eigen::Vector3d::UnitX()), 11.0, 1e-12);
  EXPECT_NEAR(support(drill, motion, -Eigen::Vector3d::UnitX()), -8.0, 1e-12);
}

TEST(ConvexShapeTest, RadiusAboutBoundsTheDistanceFromAnyAxisThroughTheTip) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000; ++i) {
    const ConvexShape tool = randomTool(random, 1.0);
    const Eigen::Vector3d axis = random.direction();
    double farthest = 0.0;
    for (const Eigen::Vector3d& p : roundToolPoints_T(tool, 64)) farthest = std::max(farthest, axis.cross(p).norm());
    EXPECT_GE(tool.radiusAbout(axis), farthest - 1e-15) << "tool " << i;
    EXPECT_LE(tool.radiusAbout(axis), 1.5 * farthest) << "tool " << i;
  }
}

// A point of a drill that spins about its own axis moves within its radius.
TEST(ConvexShapeTest, RadiusAboutItsOwnAxisIsItsRadius) {
  EXPECT_EQ(ConvexShape::cylinder(0.5, 2.0).radiusAbout(Eigen::Vector3d::UnitZ()), 0.5);
  EXPECT_EQ(ConvexShape::cylinder(0.5, 2.0).radiusAbout(Eigen::Vector3d::UnitY()), 2.5);
}

TEST(ConvexShapeTest, SupportPointsOfItsFacesAreOnTheirRims) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0);
  EXPECT_TRUE(drill.frontSupport({3, 4, 7}).isApprox(Eigen::Vector3d(0.3, 0.4, 0.0), 1e-15));
  EXPECT_TRUE(drill.rearSupport({-3, 4, 7}).isApprox(Eigen::Vector3d(-0.3, 0.4, -2.0), 1e-15));
  EXPECT_EQ(drill.frontSupport(Eigen::Vector3d::UnitZ()), Eigen::Vector3d(0, 0, 0));
}

// A prism of 4 sides, radius 1, length 2: 16 triangles, 48 corners; 5 at each of its 8 rim vertices, 4 at each center.
// So the sum of x^2 is 5 * 4, and every z differs from the mean by 1.
TEST(ConvexShapeTest, MomentsAreThePapersSumsOverTriangleCorners) {
  const ConvexShape prism = ConvexShape::cylinder(/*radius=*/1.0, /*length=*/2.0, /*sides=*/4);
  ASSERT_EQ(prism.mesh_T().triangles().size(), 16U);
  EXPECT_TRUE(prism.moments_T().mean.isApprox(Eigen::Vector3d(0, 0, -1), 1e-12));
  const Eigen::Vector3d diagonal(20.0 / 48.0, 20.0 / 48.0, 1.0);
  EXPECT_TRUE(prism.moments_T().covariance.isApprox(Eigen::Matrix3d(diagonal.asDiagonal()), 1e-7));
}

TEST(ConvexShapeTest, MeshIsClosedAndTouchesTheRoundToolFromInside) {
  const ConvexShape drill = ConvexShape::cylinder(0.5, 2.0, /*sides=*/8);
  double six_volumes = 0.0;
  for (const Triangle& triangle : drill.mesh_T().triangles()) {
    const auto p = [&](size_t i) { return drill.mesh_T().vertex(triangle[i]); };
    six_volumes += p(0).dot(p(1).cross(p(2)));
  }
  const double octagon = 0.5 * 8 * 0.5 * 0.5 * std::sin(std::acos(-1.0) / 4);
  EXPECT_NEAR(std::abs(six_volumes / 6.0), 2.0 * octagon, 1e-6);
}

TEST(ConvexShapeTest, RefusesSizesOutOfRange) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1e-9, nan, infinity, 1.1e7}) {
    EXPECT_THROW(ConvexShape::cylinder(bad, 1.0), InvalidInput) << bad;
    EXPECT_THROW(ConvexShape::cylinder(1.0, bad), InvalidInput) << bad;
  }
  EXPECT_THROW(ConvexShape::cylinder(0.0, 0.0), InvalidInput);
  for (const int sides : {-1, 0, 2, 1001}) EXPECT_THROW(ConvexShape::cylinder(1.0, 1.0, sides), InvalidInput) << sides;
}

TEST(ConvexShapeTest, AcceptsFlatAndNeedleTools) {
  EXPECT_EQ(ConvexShape::cylinder(0.0, 1.0).support(Eigen::Vector3d::UnitX()), 0.0);
  EXPECT_EQ(ConvexShape::cylinder(1.0, 0.0, 3).support(-Eigen::Vector3d::UnitZ()), 0.0);
  EXPECT_EQ(ConvexShape::cylinder(1.0, 1.0, 1000).mesh_T().triangles().size(), 4000U);
}

}  // namespace
}  // namespace sweep_guard_core
