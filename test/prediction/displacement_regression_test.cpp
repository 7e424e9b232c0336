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

TEST(DisplacementRegressionTest, IsConstantVelocityBeforeItHasLearned) {
  EXPECT_EQ(DisplacementRegression(kAhead, kPriorSpeed).weights(), kAhead * DisplacementRegression::Weights::Unit(0));
}

// An operator whose motions of the last 0.3 s carry on for 0.2 s and then stop.
TEST(DisplacementRegressionTest, LearnsTheWeightsOfTheVelocities) {
  Random random(1);
  DisplacementRegression regression(kAhead, kPriorSpeed);
  for (int i = 0; i < 2000; ++i) {
    const DisplacementRegression::Velocities velocities = anyVelocities(random, 0.3);
    regression.learn(velocities, 0.2 * velocities.col(2), kPeriod);
  }
  EXPECT_LT((regression.weights() - 0.2 * DisplacementRegression::Weights::Unit(2)).norm(), 1e-3);
}

TEST(DisplacementRegressionTest, FollowsAnOperatorWhoChanges) {
  Random random(2);
  DisplacementRegression regression(kAhead, kPriorSpeed);
  for (int i = 0; i < 20000; ++i) {
    const DisplacementRegression::Velocities velocities = anyVelocities(random, 0.3);
    regression.learn(velocities, (i < 10000 ? 0.5 : 0.1) * velocities.col(0), kPeriod);
  }
  EXPECT_NEAR(regression.weights()[0], 0.1, 0.01);
}

// Velocities that say nothing of where the tool goes: to hold still errs least.
TEST(DisplacementRegressionTest, PredictsNoMotionWhereVelocitiesMislead) {
  Random random(3);
  DisplacementRegression regression(kAhead, kPriorSpeed);
  for (int i = 0; i < 3000; ++i) regression.learn(anyVelocities(random, 1.0), 0.05 * random.direction(), kPeriod);
  EXPECT_LT(regression.weights().norm(), 0.02);
}

// Noise about a tool at rest, and then it goes: what was learned from the noise must not be blown up by the motion.
TEST(DisplacementRegressionTest, DoesNotExplodeWhenRestEnds) {
  Random random(4);
  DisplacementRegression regression(kAhead, kPriorSpeed);
  for (int i = 0; i < 300; ++i) regression.learn(anyVelocities(random, 1e-4), 1e-5 * random.direction(), kPeriod);
  for (int i = 0; i < 50; ++i) {
    regression.learn(anyVelocities(random, 1e-4), Eigen::Vector3d(0.1 * i / 50, 0.0, 0.0), kPeriod);
    EXPECT_LT(regression.weights().cwiseAbs().maxCoeff(), 3.0 * kAhead);
  }
}

}  // namespace
}  // namespace sweep_guard_core
