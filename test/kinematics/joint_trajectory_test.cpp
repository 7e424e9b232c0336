// Trajectories of a shoulder that turns, a rail that slides, and a drill that turns without end.
#include "sweep_guard/kinematics/joint_trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "refusal.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

const Time kBegin{std::chrono::seconds(100)};

TreeLink jointLink(const std::string& joint, size_t variable, JointType type) {
  TreeLink link;
  link.name = "link of " + joint;
  link.joint = joint;
  link.type = type;
  link.variable = variable;
  if (variable > 0) link.parent = variable - 1;
  return link;
}

KinematicTree shoulderRailDrill() {
  return {{{"shoulder", -3.0, 3.0}, {"rail", -1.0, 1.0}, {"drill", -1e4, 1e4, /*continuous=*/true}},
          {jointLink("shoulder", 0, JointType::kRevolute), jointLink("rail", 1, JointType::kPrismatic),
           jointLink("drill", 2, JointType::kRevolute)}};
}

class JointTrajectoryTest : public testing::Test {
 protected:
  JointTrajectory begun(const TrajectoryPlan& plan, const std::vector<double>& measured = {0.0, 0.0, 0.0}) const {
    return {tree_, {{}, {"head"}}, plan, kBegin, measured};
  }
  std::vector<double> predicted(const JointTrajectory& trajectory, double now, const std::vector<double>& measured,
                                double ahead) {
    std::vector<double> positions = {7.0, 8.0, 9.0};
    variances_ = {0.7, 0.8, 0.9};
    trajectory.predict(kBegin + fromSeconds(now), measured, fromSeconds(ahead), positions, variances_);
    return positions;
  }

  const KinematicTree tree_ = shoulderRailDrill();
  std::vector<double> variances_;
};

TEST(SampledTest, IsStraightWithoutVelocities) {
  const SampledPositions samples = sampled({{"a"}, {{milliseconds(100), {1.0}}, {milliseconds(200), {2.0}, {}}}});
  EXPECT_EQ(samples.times.size(), 6U);
  for (size_t i = 0; i < samples.times.size(); ++i) {
    EXPECT_EQ(samples.times[i], milliseconds(100 + 20 * i));
    EXPECT_NEAR(samples.positions[i].at(0), 1.0 + 0.2 * static_cast<double>(i), 1e-12);
  }
}

TEST(SampledTest, IsExactForACubicAndAQuinticMotion) {
  const auto cubic = [](double t) { return 0.3 - t + 2.0 * t * t + 0.5 * t * t * t; };
  const auto cubic_rate = [](double t) { return -1.0 + 4.0 * t + 1.5 * t * t; };
  const auto quintic = [](double t) { return std::pow(t, 5) - 2.0 * std::pow(t, 4) + t; };
  const auto quintic_rate = [](double t) { return 5.0 * std::pow(t, 4) - 8.0 * std::pow(t, 3) + 1.0; };
  const auto quintic_acceleration = [](double t) { return 20.0 * std::pow(t, 3) - 24.0 * t * t; };
  TrajectoryPlan of_cubic{{"a"}, {}};
  TrajectoryPlan of_quintic{{"a"}, {}};
  for (const double t : {0.0, 0.5, 1.3}) {
    of_cubic.points.push_back({fromSeconds(t), {cubic(t)}, {cubic_rate(t)}});
    of_quintic.points.push_back({fromSeconds(t), {quintic(t)}, {quintic_rate(t)}, {quintic_acceleration(t)}});
  }
  const SampledPositions cubics = sampled(of_cubic);
  const SampledPositions quintics = sampled(of_quintic);
  ASSERT_EQ(cubics.times.size(), 66U);
  for (size_t i = 0; i < cubics.times.size(); ++i) {
    EXPECT_NEAR(cubics.positions[i][0], cubic(toSeconds(cubics.times[i])), 1e-9);
    EXPECT_NEAR(quintics.positions[i][0], quintic(toSeconds(quintics.times[i])), 1e-9);
  }
}

TEST(SampledTest, HasEachPointAndNoStepAbove20Milliseconds) {
  const SampledPositions samples =
      sampled({{"a"}, {{{}, {0.0}}, {milliseconds(7), {1.0}}, {milliseconds(48), {2.0}}, {milliseconds(68), {3.0}}}});
  const std::vector<double> of_points = {0.0, 1.0, 2.0, 3.0};
  size_t found = 0;
  for (size_t i = 0; i < samples.times.size(); ++i) {
    found += static_cast<size_t>(std::count(of_points.begin(), of_points.end(), samples.positions[i][0]));
    const Duration step = i == 0 ? kTrajectoryStep : samples.times[i] - samples.times[i - 1];
    EXPECT_LE(step, kTrajectoryStep);
    EXPECT_GT(step, Duration::zero());
  }
  EXPECT_EQ(found, 4U);
}

TEST(SampledTest, RefusesWhatIsNoTrajectory) {
  const auto refused = [](const std::vector<TrajectoryPoint>& points) {
    return refusal([&] { sampled({{"a"}, points}); });
  };
  EXPECT_EQ(refused({}), "trajectory has no points");
  EXPECT_EQ(refused({{{}, {0.0}}, {{}, {1.0}}}), "point 1 of the trajectory is not later than the one before");
  EXPECT_EQ(refused({{milliseconds(-1), {0.0}}}), "point 0 of the trajectory is not later than the one before");
  EXPECT_EQ(refused({{{}, {0.0, 1.0}}}), "point 0 of the trajectory has 2 numbers for 1 joints");
  EXPECT_EQ(refused({{{}, {0.0}, {1.0, 2.0}}}), "point 0 of the trajectory has 2 numbers for 1 joints");
  const std::string not_finite = "point 0 of the trajectory has a number that is not finite";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused({{{}, {nan}}}), not_finite);
  EXPECT_EQ(refused({{{}, {0.0}, {INFINITY}}}), not_finite);
  EXPECT_EQ(refused({{{}, {0.0}, {0.0}, {nan}}}), not_finite);
  EXPECT_EQ(refused({{{}, {0.0}}, {std::chrono::seconds(601), {1.0}}}), "trajectory lasts longer than 10 minutes");
}

TEST_F(JointTrajectoryTest, RefusesTheJointsOfAnotherRobot) {
  EXPECT_TRUE(has(refusal([&] { begun({{"knee"}, {{{}, {0.0}}}}); }), "has no joint 'knee'"));
  EXPECT_TRUE(has(refusal([&] { begun({{"shoulder"}, {{{}, {3.5}}}}); }), "its limits are -3 to 3"));
}

// Its own order of joints, and one that is not the tool's.
TEST_F(JointTrajectoryTest, MovesItsJointsAndNoOthers) {
  const auto trajectory =
      begun({{"rail", "head", "shoulder"}, {{{}, {0.0, 0.0, 0.0}}, {milliseconds(1000), {0.1, 5.0, 1.0}}}});
  const auto positions = predicted(trajectory, 0.25, {0.25, 0.025, 0.4}, 0.5);
  EXPECT_NEAR(positions[0], 0.75, 1e-9);
  EXPECT_NEAR(positions[1], 0.075, 1e-9);
  EXPECT_EQ(positions[2], 9.0);
  EXPECT_NEAR(variances_[0], 1e-6, 1e-12);
  EXPECT_EQ(variances_[2], 0.9);
}

TEST_F(JointTrajectoryTest, StaysAtItsEnd) {
  const auto trajectory = begun({{"shoulder"}, {{{}, {0.0}}, {milliseconds(1000), {1.0}}}});
  EXPECT_NEAR(predicted(trajectory, 0.8, {0.8, 0.0, 0.0}, 3.0)[0], 1.0, 1e-9);
  EXPECT_NEAR(predicted(trajectory, 5.0, {1.0, 0.0, 0.0}, 0.1)[0], 1.0, 1e-9);
}

// The controller begins at rest.
TEST_F(JointTrajectoryTest, GoesFromWhereItIsMeasuredToALaterFirstPoint) {
  const std::vector<double> measured = {0.4, 0.0, 0.0};
  const auto smooth = begun({{"shoulder"}, {{milliseconds(1000), {1.4}, {0.0}}}}, measured);
  EXPECT_NEAR(predicted(smooth, 0.0, measured, 0.2)[0], 0.4 + 0.04 * (3.0 - 0.4), 1e-9);
  EXPECT_NEAR(predicted(smooth, 0.0, measured, 1.0)[0], 1.4, 1e-9);
  const auto straight = begun({{"shoulder"}, {{milliseconds(1000), {1.4}}}}, measured);
  EXPECT_NEAR(predicted(straight, 0.0, measured, 0.2)[0], 0.6, 1e-9);
}

// A driver may count turns otherwise than the planner: the way is the same.
TEST_F(JointTrajectoryTest, AContinuousJointMayBeAWholeTurnOff) {
  const std::vector<double> measured = {0.0, 0.0, 0.1 - 4.0 * M_PI};
  const auto trajectory = begun({{"drill"}, {{milliseconds(1000), {1.1}}}}, measured);
  EXPECT_TRUE(trajectory.isFollowed(kBegin, measured));
  EXPECT_NEAR(predicted(trajectory, 0.0, measured, 1.0)[2], 1.1 - 4.0 * M_PI, 1e-9);
}

TEST_F(JointTrajectoryTest, WhatIsOffGoesBackAndIsInTheVariance) {
  const auto trajectory = begun({{"shoulder"}, {{{}, {0.0}}, {milliseconds(1000), {1.0}}}});
  const std::vector<double> measured = {0.27, 0.0, 0.0};  // 0.03 behind
  for (const double ahead : {1e-9, 0.1, 0.7}) {
    const double gone = 0.03 * (1.0 - std::exp(-10.0 * ahead));
    EXPECT_NEAR(predicted(trajectory, 0.3, measured, ahead)[0], 0.27 + ahead + gone, 1e-9);
    EXPECT_NEAR(variances_[0], gone * gone + 1e-6, 1e-9);
  }
}

TEST_F(JointTrajectoryTest, IsFollowedWithALagOf200Milliseconds) {
  const auto trajectory = begun({{"shoulder", "rail"}, {{{}, {0.0, 0.0}}, {milliseconds(1000), {2.0, 0.0}}}});
  const auto follows = [&](double shoulder, double rail) {
    return trajectory.isFollowed(kBegin + milliseconds(500), {shoulder, rail, 0.0});
  };
  EXPECT_TRUE(follows(1.0, 0.0));
  EXPECT_TRUE(follows(0.56, 0.0));  // 0.2 s ago, the trajectory was at 0.6
  EXPECT_FALSE(follows(0.54, 0.0));
  EXPECT_TRUE(follows(1.04, 0.0));
  EXPECT_FALSE(follows(1.06, 0.0));
  EXPECT_TRUE(follows(1.0, -0.019));
  EXPECT_FALSE(follows(1.0, 0.021));
}

TEST_F(JointTrajectoryTest, TheRestBeginsWhereTheJointsAreAndEndsWithThePlan) {
  const auto trajectory = begun({{"shoulder"}, {{{}, {0.0}}, {milliseconds(100), {0.1}}}});
  const auto rest = trajectory.rest(kBegin + milliseconds(50), {0.04, 0.5, 0.0});
  EXPECT_EQ(rest.times, (std::vector<Duration>{{}, milliseconds(50)}));
  EXPECT_EQ(rest.positions[0], (std::vector<double>{0.04, 0.5, 0.0}));
  EXPECT_NEAR(rest.positions[1][0], 0.1 - 0.01 * std::exp(-0.5), 1e-9);
  EXPECT_EQ(rest.positions[1][1], 0.5);
  EXPECT_EQ(trajectory.rest(kBegin + milliseconds(100), {0.1, 0.5, 0.0}).times.size(), 1U);
}

// A smooth motion with a corner: few states are left of 150, which are straight in between.
TEST_F(JointTrajectoryTest, TheRestHasFewStatesAndLeavesThePlanByNoMoreThanAMilliradian) {
  const auto trajectory = begun({{"shoulder", "rail"},
                                 {{{}, {0.0, 0.0}, {0.0, 0.0}},
                                  {milliseconds(1000), {0.8, 0.1}, {0.5, 0.0}},
                                  {milliseconds(2000), {1.0, -0.1}, {0.0, 0.0}},
                                  {milliseconds(3000), {-1.0, 0.3}}}});
  const auto rest = trajectory.rest(kBegin, {0.0, 0.0, 0.0});
  EXPECT_LT(rest.times.size(), 50U);
  EXPECT_EQ(rest.times.back(), milliseconds(3000));
  for (size_t i = 1; i < rest.times.size(); ++i) {
    for (double share = 0.05; share < 1.0; share += 0.1) {
      const double ahead = (1.0 - share) * toSeconds(rest.times[i - 1]) + share * toSeconds(rest.times[i]);
      const auto planned_there = predicted(trajectory, 0.0, {0.0, 0.0, 0.0}, ahead);
      for (size_t joint = 0; joint < 2; ++joint) {
        const double tested = (1.0 - share) * rest.positions[i - 1][joint] + share * rest.positions[i][joint];
        EXPECT_NEAR(tested, planned_there[joint], 1e-3 + 1e-9) << ahead;
      }
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
