#include "sweep_guard/geometry/oriented_box.h"

#include <gtest/gtest.h>

#include "geometry/round_tool.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

constexpr int kBoxMotions = 20'000;

Motion standstill() { return {}; }

Motion translation(const Eigen::Vector3d& step) {
  Motion motion;
  motion.X_MT_end.translation() = step;
  return motion;
}

void expectValid(const OrientedBox& box) {
  const Eigen::Matrix3d& R = box.X_MB.linear();
  EXPECT_TRUE((R.transpose() * R).isIdentity(1e-12));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_TRUE(box.X_MB.translation().allFinite());
  EXPECT_GE(box.half_extents.x(), 0.0);
  EXPECT_LE(box.half_extents.x(), box.half_extents.y());
  EXPECT_LE(box.half_extents.y(), box.half_extents.z());
}

// The sums of [P, Sec. 3.1], directly over the corners of the triangles of both tools.
Eigen::Matrix3d papersCovariance(const ConvexShape& tool, const Motion& motion) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Isometry3d& X_MT : {motion.X_MT_start, motion.X_MT_end}) {
    for (const Triangle& triangle : tool.mesh_T().triangles()) {
      for (const std::uint32_t vertex : triangle) corners.push_back(X_MT * tool.mesh_T().vertex(vertex));
    }
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : corners) mean += p / static_cast<double>(corners.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : corners) {
    covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(corners.size());
  }
  return covariance;
}

// A drill that moves along its axis covers a longer drill.
TEST(OrientedBoxTest, EnclosesADrillThatMovesAlongItsAxis) {
  const OrientedBox box = boundingBox(ConvexShape::cylinder(0.5, 2.0), translation({0, 0, 4}));
  EXPECT_TRUE(box.half_extents.isApprox(Eigen::Vector3d(0.5, 0.5, 3.0), 1e-9));
  EXPECT_TRUE(box.X_MB.translation().isApprox(Eigen::Vector3d(0, 0, 1), 1e-9));
  EXPECT_NEAR(std::abs(box.X_MB.linear()(2, 2)), 1.0, 1e-12);
}

// Sideways by more than its length: the direction of motion is the longest axis, the drill's axis the second.
TEST(OrientedBoxTest, OrdersItsAxesByExtent) {
  const OrientedBox box = boundingBox(ConvexShape::cylinder(0.5, 2.0), translation({6, 0, 0}));
  EXPECT_TRUE(box.half_extents.isApprox(Eigen::Vector3d(0.5, 1.0, 3.5), 1e-9));
  EXPECT_NEAR(std::abs(box.X_MB.linear()(0, 2)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(box.X_MB.linear()(2, 1)), 1.0, 1e-9);
}

TEST(OrientedBoxTest, IsValidForDegenerateTools) {
  for (const Motion& motion : {standstill(), translation({0, 0, 1}), translation({1e-12, 0, 0})}) {
    for (const ConvexShape& tool :
         {ConvexShape::cylinder(1.0, 0.0), ConvexShape::cylinder(0.0, 1.0), ConvexShape::cylinder(1.0, 1.0),
          ConvexShape::cylinder(1e-9, 1e3), ConvexShape::cylinder(1e3, 1e-9, 3)}) {
      SCOPED_TRACE("radius " + std::to_string(tool.radius()) + ", length " + std::to_string(tool.length()));
      expectValid(boundingBox(tool, motion));
    }
  }
}

// The variances of the corners are equal along all axes if length^2 = 10/6 radius^2 (see ConvexShapeTest's prism): any
// axes are eigenvectors.
TEST(OrientedBoxTest, IsValidForEqualEigenvalues) {
  const ConvexShape cube_like = ConvexShape::cylinder(1.0, std::sqrt(10.0 / 6.0), /*sides=*/4);
  const Eigen::Matrix3d covariance = cube_like.moments_T().covariance;
  ASSERT_TRUE(covariance.isApprox(covariance(0, 0) * Eigen::Matrix3d::Identity(), 1e-6));
  expectValid(boundingBox(cube_like, standstill()));
}

TEST(OrientedBoxTest, HoldsTheRoundToolAtBothPosesTightly) {
  Random random(/*seed=*/1);
  for (int i = 0; i < kBoxMotions && !HasFailure(); ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
    const double size = tool.radius() + tool.length();
    const Motion motion = randomMotion(random, tool, size * random.direction(), /*max_angle=*/3.14);
    const OrientedBox box = boundingBox(tool, motion);
    expectValid(box);
    Eigen::AlignedBox3d held;
    for (const Eigen::Isometry3d& X_MT : {motion.X_MT_start, motion.X_MT_end}) {
      for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 64)) held.extend(box.X_MB.inverse() * (X_MT * p_T));
    }
    const double rounding = 1e-14 * size;
    const double between_points = 0.0013 * tool.radius();  // 1 - cos(pi / 64), a rim point between two of 64
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(held.max()[axis], box.half_extents[axis] + rounding);
      EXPECT_GE(held.min()[axis], -box.half_extents[axis] - rounding);
      EXPECT_GE(held.max()[axis], box.half_extents[axis] - between_points - rounding);
      EXPECT_LE(held.min()[axis], -box.half_extents[axis] + between_points + rounding);
    }
  }
}

TEST(OrientedBoxTest, AxesAreEigenvectorsOfThePapersCovariance) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const ConvexShape tool = randomTool(random, 1.0);
    const Motion motion = randomMotion(random, tool, random.direction(), /*max_angle=*/3.14);
    const Eigen::Matrix3d R = boundingBox(tool, motion).X_MB.linear();
    const Eigen::Matrix3d diagonal = R.transpose() * papersCovariance(tool, motion) * R;
    EXPECT_TRUE(diagonal.isDiagonal(1e-9)) << diagonal;
  }
}

}  // namespace
}  // namespace sweep_guard_core
