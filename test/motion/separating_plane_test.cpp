#include "sweep_guard/motion/separating_plane.h"

#include <gtest/gtest.h>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

double support(const std::vector<ToolBall>& balls, const Vector3d& direction) {
  double most = -1e300;
  for (const ToolBall& ball : balls) most = std::max(most, direction.dot(ball.center_T) + ball.radius);
  return most;
}

Eigen::Isometry3d poseOf(RandomScenes& random) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()).toRotationMatrix();
  X.translation() = random.direction();
  return X;
}

TEST(EnclosingBallsTest, ContainTheBodyAndLittleMore) {
  RandomScenes random(1);
  std::vector<Vector3d> points;
  for (int i = 0; i < 30; ++i) points.emplace_back(random.uniform(0.0, 0.1) * random.direction());
  for (const ConvexShape& shape : {ConvexShape::cylinder(0.02, 0.1), ConvexShape::sphere(0.03),
                                   ConvexShape::box({0.01, 0.02, 0.03}), ConvexShape::hull(points)}) {
    const ConvexShape placed = shape.padded(0.003).placed(poseOf(random));
    const auto balls = enclosingBalls(placed);
    for (int i = 0; i < 1000; ++i) {
      const Vector3d direction = random.direction();
      EXPECT_GE(support(balls, direction), placed.support(direction) - 1e-12);
      EXPECT_LE(support(balls, direction), placed.support(direction) + 0.0005);
    }
  }
}

TEST(EnclosingBallsTest, ASphereIsOne) {
  const auto balls = enclosingBalls(ConvexShape::sphere(0.03));
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_EQ(balls[0].radius, 0.03);
}

TEST(FacingBallTest, CarriesAPlaneByANewerPose) {
  const SeparatingPlane plane{0, Vector3d::UnitZ(), {7.0, 8.0, 1.0}, 0.5, 0.25};
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.linear() = Eigen::AngleAxisd(M_PI / 2.0, Vector3d::UnitX()).toRotationMatrix();
  X_WT.translation() = Vector3d(0.0, 0.0, 2.0);
  std::vector<FacingBall> facing;
  addFacingBalls(plane, {{{0.0, 0.3, 0.0}, 0.1}, {{0.0, -0.3, 0.0}, 0.1}}, X_WT, facing);
  ASSERT_EQ(facing.size(), 2U);
  EXPECT_NEAR(facing[0].gap, 1.2, 1e-12);
  EXPECT_NEAR(facing[1].gap, 0.6, 1e-12);
  EXPECT_TRUE(facing[0].center_W.isApprox(Vector3d(0.0, 0.0, 0.3)));
  EXPECT_EQ(facing[0].normal_W, Vector3d::UnitZ());
  EXPECT_EQ(facing[0].surface_speed, 0.25);
}

}  // namespace
}  // namespace sweep_guard_core
