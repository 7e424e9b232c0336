#include "prediction/displacement_regression.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

constexpr double kAhead = 0.5;        // [s]
constexpr double kPriorSpeed = 0.02;  // [m/s]
constexpr double kPeriod = 0.01;      // [s]

DisplacementRegression::Velocities anyVelocities(Random& random, double speed) {
  DisplacementRegression::Velocities velocities;
  for (int i = 0; i < DisplacementRegression::kVelocities; ++i) velocities.col(i) = speed * random.direction();
  return velocities;
}

TEST(CarryTest, IsConstantVelocityBeforeItHasLearned) {
  EXPECT_EQ(DisplacementRegression(kAhead, kPriorSpeed).weights(), kAhead * DisplacementRegression::Weights::Unit(0));
}

// An operator whose motions of the last 0.3 s carry on for 0.2 s and then stop.
TEST(CarryTest, LearnsWhichVelocitiesCarryAndHowFar) {
  Random random(1);
  DisplacementRegression carry(kAhead, kPriorSpeed);
  for (int i = 0; i < 2000; ++i) {
    const DisplacementRegression::Velocities velocities = anyVelocities(random, 0.3);
    carry.learn(velocities, 0.2 * velocities.col(2), kPeriod);
  }
  EXPECT_LT((carry.weights() - 0.2 * DisplacementRegression::Weights::Unit(2)).norm(), 1e-3);
}

TEST(CarryTest, FollowsAnOperatorWhoChanges) {
  Random random(2);
  DisplacementRegression carry(kAhead, kPriorSpeed);
  for (int i = 0; i < 20000; ++i) {
    const DisplacementRegression::Velocities velocities = anyVelocities(random, 0.3);
    carry.learn(velocities, (i < 10000 ? 0.5 : 0.1) * velocities.col(0), kPeriod);
  }
  EXPECT_NEAR(carry.weights()[0], 0.1, 0.01);
}

// Velocities that say nothing of where the tool goes: to hold still errs least.
TEST(CarryTest, LeansOnHoldingStillWhereVelocitiesMislead) {
  Random random(3);
  DisplacementRegression carry(kAhead, kPriorSpeed);
  for (int i = 0; i < 3000; ++i) carry.learn(anyVelocities(random, 1.0), 0.05 * random.direction(), kPeriod);
  EXPECT_LT(carry.weights().norm(), 0.02);
}

// Noise about a tool at rest, and then it goes: what was learned from the noise must not be blown up by the motion.
TEST(CarryTest, DoesNotExplodeWhenRestEnds) {
  Random random(4);
  DisplacementRegression carry(kAhead, kPriorSpeed);
  for (int i = 0; i < 300; ++i) carry.learn(anyVelocities(random, 1e-4), 1e-5 * random.direction(), kPeriod);
  for (int i = 0; i < 50; ++i) {
    carry.learn(anyVelocities(random, 1e-4), Eigen::Vector3d(0.1 * i / 50, 0.0, 0.0), kPeriod);
    EXPECT_LT(carry.weights().cwiseAbs().maxCoeff(), 3.0 * kAhead);
  }
}

}  // namespace
}  // namespace sweep_guard_core
