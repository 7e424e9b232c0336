#include "simulation/guided_tip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kTipStep = 0.01;  // [s]
constexpr double kTiny = 1e-12;
const Twist kForward{/*v_W=*/{0.1, 0.0, 0.0}};

Isometry3d poseAt(const Vector3d& position, double angle = 0.0) {
  Isometry3d pose(AngleAxisd(angle, Vector3d(1, 2, 3).normalized()));
  pose.translation() = position;
  return pose;
}

double turnBetween(const Isometry3d& a, const Isometry3d& b) {
  return AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

class GuidedTipAtAnyRateTest : public ::testing::TestWithParam<double> {
 protected:
  const GuidedTip::Limits limits_ = {};
};

// Speed and change of speed are read off the poses alone, as a listener would.
TEST_P(GuidedTipAtAnyRateTest, MovesWithinItsLimitsWhenTheGoalJumps) {
  const double dt = GetParam();
  GuidedTip tip(poseAt({0, 0, 0}), limits_);
  Vector3d velocity = Vector3d::Zero();
  Vector3d turn_rate = Vector3d::Zero();
  for (int i = 0; i * dt < 10.0; ++i) {
    const Isometry3d before = tip.pose();
    const bool far = std::fmod(i * dt, 2.0) < 1.0;
    tip.moveTowards(far ? poseAt({0.5, -0.2, 0.1}, 2.5) : poseAt({-0.3, 0.0, 0.4}, -0.4), dt);
    const Vector3d next_velocity = (tip.pose().translation() - before.translation()) / dt;
    const AngleAxisd turn(tip.pose().linear() * before.linear().transpose());
    const Vector3d next_turn_rate = turn.angle() * turn.axis() / dt;
    EXPECT_LE(next_velocity.norm(), limits_.speed + 1e-9);
    EXPECT_LE((next_velocity - velocity).norm(), limits_.acceleration * dt + 1e-9);
    EXPECT_LE(next_turn_rate.norm(), limits_.turn_rate + 1e-6);
    EXPECT_LE((next_turn_rate - turn_rate).norm(), limits_.turn_acceleration * dt + 1e-6);
    velocity = next_velocity;
    turn_rate = next_turn_rate;
  }
}

TEST_P(GuidedTipAtAnyRateTest, ComesToRestAtTheGoalWithoutPassingIt) {
  const double dt = GetParam();
  const Isometry3d goal = poseAt({0.3, -0.1, 0.2}, 2.0);
  GuidedTip tip(poseAt({0, 0, 0}), limits_);
  double distance = goal.translation().norm();
  double turn = 2.0;
  for (int i = 0; i * dt < 10.0; ++i) {
    tip.moveTowards(goal, dt);
    const double next_distance = (tip.pose().translation() - goal.translation()).norm();
    const double next_turn = turnBetween(tip.pose(), goal);
    EXPECT_LE(next_distance, distance + 1e-9);
    EXPECT_LE(next_turn, turn + 1e-6);
    distance = next_distance;
    turn = next_turn;
  }
  EXPECT_LT(distance, 1e-6);
  EXPECT_LT(turn, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Rates, GuidedTipAtAnyRateTest, ::testing::Values(0.001, 0.01, 0.1));

TEST(GuidedTipTest, StaysWhereItIsWhenItIsThere) {
  const Isometry3d goal = poseAt({0.1, 0.2, 0.3});
  GuidedTip tip(goal, {});
  for (int i = 0; i < 100; ++i) tip.moveTowards(goal, kTipStep);
  EXPECT_TRUE(tip.pose().isApprox(goal, kTiny));
}

// From rest to 0.1 m/s at 1 m/s^2 takes 10 steps, and as many to stop.
TEST(GuidedTipTest, TakesUpAVelocityAndStops) {
  GuidedTip tip(poseAt({0, 0, 0}), {});
  for (int i = 0; i < 20; ++i) tip.moveAt(kForward, kTipStep);
  Vector3d before = tip.pose().translation();
  tip.moveAt(kForward, kTipStep);
  EXPECT_TRUE((tip.pose().translation() - before).isApprox(Vector3d(0.001, 0, 0), 1e-9));
  for (int i = 0; i < 10; ++i) tip.moveAt({}, kTipStep);
  before = tip.pose().translation();
  tip.moveAt({}, kTipStep);
  EXPECT_TRUE(tip.pose().translation().isApprox(before, kTiny));
}

// The first step from rest: 1 m/s^2 over 0.01 s.
TEST(GuidedTipTest, StartsFromRestAfterwardsAsAtFirst) {
  GuidedTip tip(poseAt({0, 0, 0}), {});
  for (int i = 0; i < 20; ++i) tip.moveAt(kForward, kTipStep);
  tip.stop();
  const Vector3d before = tip.pose().translation();
  tip.moveAt(kForward, kTipStep);
  EXPECT_TRUE((tip.pose().translation() - before).isApprox(Vector3d(0.0001, 0, 0), 1e-9));
}

TEST(GuidedTipTest, TurnsAboutTheAxesOfTheWorldAndItsTip) {
  GuidedTip tip(Isometry3d(Eigen::Translation3d(1, 2, 3) * AngleAxisd(M_PI, Vector3d::UnitX())), {});
  const Isometry3d before = tip.pose();
  Twist desired;
  desired.w_W.z() = 1.0;
  for (int i = 0; i < 100; ++i) tip.moveAt(desired, kTipStep);
  const AngleAxisd turn(tip.pose().linear() * before.linear().transpose());
  EXPECT_TRUE(turn.axis().isApprox(Vector3d::UnitZ(), 1e-9));
  EXPECT_GT(turn.angle(), 0.8);
  EXPECT_EQ(tip.pose().translation(), before.translation());
}

TEST(GuidedTipTest, RotationsStayRotations) {
  GuidedTip tip(poseAt({0, 0, 0}), {});
  Twist desired;
  desired.w_W << 1, -1, 1;
  for (int i = 0; i < 100000; ++i) tip.moveAt(desired, kTipStep);
  EXPECT_TRUE((tip.pose().linear().transpose() * tip.pose().linear()).isIdentity(1e-12));
}

TEST(GuidedTipTest, RefusesLimitsThatAllowNoMotion) {
  GuidedTip::Limits limits;
  limits.acceleration = 0.0;
  EXPECT_THROW(GuidedTip(Isometry3d::Identity(), limits), sweep_guard_core::InvalidInput);
  limits.acceleration = NAN;
  EXPECT_THROW(GuidedTip(Isometry3d::Identity(), limits), sweep_guard_core::InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_simulation
