#include "sweep_guard/geometry/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/round_tool.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

constexpr double kDegree = M_PI / 180.0;

Eigen::Isometry3d turnedAboutZ(double degrees, const Eigen::Vector3d& place = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = place;
  return pose;
}

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) { return Motion{a, b}.angle(); }

TEST(MotionTest, StartsAndEndsAtItsPoses) {
  const Motion motion{turnedAboutZ(10, {1, 2, 3}), turnedAboutZ(50, {3, 2, 1})};
  EXPECT_TRUE(motion.at(0.0).isApprox(motion.X_MT_start, 1e-14));
  EXPECT_TRUE(motion.at(1.0).isApprox(motion.X_MT_end, 1e-14));
}

TEST(MotionTest, GoesStraightAndTurnsAtConstantRate) {
  const Motion motion{turnedAboutZ(0), turnedAboutZ(80, {4, 0, 8})};
  EXPECT_TRUE(motion.at(0.25).isApprox(turnedAboutZ(20, {1, 0, 2}), 1e-14));
  EXPECT_NEAR(motion.angle(), 80 * kDegree, 1e-14);
  EXPECT_TRUE(motion.axis_T().isApprox(Eigen::Vector3d::UnitZ(), 1e-14));
}

TEST(MotionTest, TurnsByTheSmallerAngle) {
  const Motion motion{turnedAboutZ(-100), turnedAboutZ(100)};
  EXPECT_NEAR(motion.angle(), 160 * kDegree, 1e-14);
  EXPECT_TRUE(motion.at(0.5).isApprox(turnedAboutZ(180), 1e-14));
}

// A rotation matrix gives a quaternion or its negative; with either, halfway is half the angle from both ends.
TEST(MotionTest, IsHalfwayBetweenAnyTwoRotations) {
  Random random(/*seed=*/1);
  for (int i = 0; i < 10'000; ++i) {
    const Motion motion{random.pose(Eigen::Vector3d::Zero()), random.pose(Eigen::Vector3d::Zero())};
    const double half = 0.5 * motion.angle();
    EXPECT_LE(half, 0.5 * M_PI);
    EXPECT_NEAR(angleBetween(motion.X_MT_start, motion.at(0.5)), half, 1e-9) << "motion " << i;
    EXPECT_NEAR(angleBetween(motion.at(0.5), motion.X_MT_end), half, 1e-9) << "motion " << i;
  }
}

// The axis is not unique there.
TEST(MotionTest, HasAUnitAxisWithoutARotationAndAtHalfATurn) {
  for (const double degrees : {0.0, 1e-9, 179.999999, 180.0, 180.000001}) {
    const Motion motion{turnedAboutZ(0), turnedAboutZ(degrees)};
    EXPECT_NEAR(motion.axis_T().norm(), 1.0, 1e-12) << degrees;
    EXPECT_NEAR(angleBetween(motion.X_MT_start, motion.at(0.5)), 0.5 * motion.angle(), 1e-9) << degrees;
  }
}

TEST(AngleBoundTest, IsNoLessThanTheAngleAndAtMostHalfOfPiTimesIt) {
  Random random(/*seed=*/5);
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Isometry3d start = random.pose(Eigen::Vector3d::Zero());
    Eigen::Isometry3d end = start;
    end.linear() = start.linear() * random.turn(random.logUniform(1e-4, M_PI));
    const double angle = angleBetween(start, end);
    const double bound = angleBound(start.linear(), end.linear());
    EXPECT_GE(bound, angle * (1.0 - 1e-9));
    EXPECT_LE(bound, 0.5 * M_PI * angle * (1.0 + 1e-9));
  }
  EXPECT_EQ(angleBound(Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()), 0.0);
}

TEST(SplitTest, MakesTheFewestSubMotionsWithinTheMaximum) {
  const Motion motion{turnedAboutZ(0), turnedAboutZ(90, {9, 0, 0})};
  EXPECT_EQ(split(motion, 91 * kDegree).size(), 1U);
  EXPECT_EQ(split(motion, 46 * kDegree).size(), 2U);
  EXPECT_EQ(split(motion, 31 * kDegree).size(), 3U);
  EXPECT_EQ(split(motion, 29 * kDegree).size(), 4U);
}

TEST(SplitTest, LeavesAMotionWithoutRotationWhole) {
  EXPECT_EQ(split({turnedAboutZ(30), turnedAboutZ(30, {1e6, 0, 0})}, 0.175).size(), 1U);
}

TEST(SplitTest, SubMotionsAreEndToEndAndCoverTheMotion) {
  Random random(/*seed=*/2);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const Motion motion{random.pose(10.0 * random.direction()), random.pose(10.0 * random.direction())};
    const double max_rotation = random.uniform(0.05, 1.5);
    const std::vector<Motion> sub_motions = split(motion, max_rotation);
    const auto count = static_cast<double>(sub_motions.size());
    EXPECT_EQ(sub_motions.front().X_MT_start.matrix(), motion.X_MT_start.matrix());
    EXPECT_EQ(sub_motions.back().X_MT_end.matrix(), motion.X_MT_end.matrix());
    for (size_t k = 0; k < sub_motions.size(); ++k) {
      EXPECT_LE(sub_motions[k].angle(), max_rotation * (1.0 + 1e-9));
      if (k > 0) {
        EXPECT_EQ(sub_motions[k].X_MT_start.matrix(), sub_motions[k - 1].X_MT_end.matrix());
      }
      const double middle = (static_cast<double>(k) + 0.5) / count;
      EXPECT_TRUE(sub_motions[k].at(0.5).isApprox(motion.at(middle), 1e-9));
    }
  }
}

TEST(ChordErrorTest, IsAnEighthOfRadiusTimesAngleSquared) {
  EXPECT_DOUBLE_EQ(chordError(0.2, 0.1), 0.00025);
  EXPECT_EQ(chordError(0.2, 0.0), 0.0);
  EXPECT_EQ(chordError(0.0, 1.0), 0.0);
}

// Samples the motion in 1000 steps: every point of the rim is within the bound from its chord.
TEST(ChordErrorTest, BoundsTheArcsOfEveryToolPoint) {
  Random random(/*seed=*/3);
  double closest = 0.0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const ConvexShape tool = randomTool(random, 1.0);
    const Motion motion = randomMotion(random, tool, random.direction(), /*max_angle=*/1.57);
    const double bound = chordError(tool.radiusAbout(motion.axis_T()), motion.angle());
    for (int step = 0; step <= 1000; ++step) {
      const double fraction = step / 1000.0;
      const Eigen::Isometry3d X_MT = motion.at(fraction);
      for (size_t vertex = 0; vertex < tool.mesh_T().vertexCount(); ++vertex) {
        const Eigen::Vector3d p_T = tool.mesh_T().vertex(vertex);
        const Eigen::Vector3d chord = (1.0 - fraction) * (motion.X_MT_start * p_T) + fraction * (motion.X_MT_end * p_T);
        const double error = (X_MT * p_T - chord).norm();
        ASSERT_LE(error, bound + 1e-12);
        if (bound > 1e-6) closest = std::max(closest, error / bound);
      }
    }
  }
  EXPECT_GT(closest, 0.9);  // the bound is nearly reached: half of it would be too small
}

// A frame turns by 0.5 rad under a needle of 0.2 m at rest, 1 m from its origin: (0.25 * 1 + 0.25 * 0.2) / 8.
TEST(RelativeMotionTest, DeviatesBecauseTheFrameTurns) {
  const Eigen::Isometry3d beside = turnedAboutZ(0, {1, 0, 0});
  const Motion turning{turnedAboutZ(0), turnedAboutZ(0.5 / kDegree)};
  const std::vector<Motion> sub_motions = split({{beside, beside}, turning}, /*max_rotation=*/1.0, /*tool_radius=*/0.2);
  ASSERT_EQ(sub_motions.size(), 1U);
  EXPECT_NEAR(sub_motions[0].deviation_bound, 0.3 / 8.0, 1e-12);
  EXPECT_TRUE(sub_motions[0].X_MT_end.translation().isApprox(Eigen::Vector3d(std::cos(0.5), -std::sin(0.5), 0), 1e-12));
}

TEST(RelativeMotionTest, HasNoDeviationWhereTheFrameOnlyMoves) {
  const Motion tool{turnedAboutZ(0), turnedAboutZ(10, {1, 0, 0})};
  const Motion frame{turnedAboutZ(30), turnedAboutZ(30, {0, 5, 0})};
  for (const Motion& sub_motion : split({tool, frame}, /*max_rotation=*/0.1, /*tool_radius=*/0.2)) {
    EXPECT_LT(sub_motion.deviation_bound, 1e-9);
  }
}

// Samples the motion seen from the frame while both turn and move.
TEST(RelativeMotionTest, BoundsTheArcsOfEveryToolPoint) {
  Random random(/*seed=*/4);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("motion " + std::to_string(i));
    const ConvexShape tool = randomTool(random, 1.0);
    const RelativeMotion motion{randomMotion(random, tool, 5.0 * random.direction(), /*max_angle=*/3.1),
                                randomMotion(random, tool, 5.0 * random.direction(), /*max_angle=*/3.1)};
    const double max_rotation = random.uniform(0.05, 0.5);
    const std::vector<Motion> sub_motions = split(motion, max_rotation, tool.boundingRadius());
    for (size_t k = 0; k < sub_motions.size(); ++k) {
      const Motion& sub_motion = sub_motions[k];
      const double bound =
          std::max(chordError(tool.radiusAbout(sub_motion.axis_T()), sub_motion.angle()), sub_motion.deviation_bound);
      EXPECT_LE(sub_motion.angle(), max_rotation * (1.0 + 1e-9));
      for (int step = 0; step <= 20; ++step) {
        const double fraction = step / 20.0;
        const double along = (static_cast<double>(k) + fraction) / static_cast<double>(sub_motions.size());
        const Eigen::Isometry3d X_MT = motion.frame_W.at(along).inverse() * motion.tool_W.at(along);
        for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 8)) {
          const Eigen::Vector3d chord =
              (1.0 - fraction) * (sub_motion.X_MT_start * p_T) + fraction * (sub_motion.X_MT_end * p_T);
          ASSERT_LE((X_MT * p_T - chord).norm(), bound + 1e-12) << "sub_motion " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
