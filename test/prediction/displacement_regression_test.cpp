#include "prediction/displacement_regression.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Regression = DisplacementRegression<3>;

constexpr double kSecondsAhead = 0.5;  // [s]
constexpr double kPriorSpeed = 0.02;   // [m/s]
constexpr double kPeriod = 0.01;       // [s]

Regression::Velocities anyVelocities(Random& random, double speed) {
  Regression::Velocities velocities;
  for (int i = 0; i < kRegressors; ++i) velocities.col(i) = speed * random.direction();
  return velocities;
}

void learn(Regression& regression, const Regression::Velocities& velocities, const Eigen::Vector3d& moved) {
  regression.learn(velocities, moved, kPeriod, Regression::constantVelocity(kSecondsAhead));
}

TEST(DisplacementRegressionTest, IsConstantVelocityBeforeItHasLearned) {
  EXPECT_EQ(Regression(kSecondsAhead, kPriorSpeed).weights(), kSecondsAhead * Regression::Weights::Unit(0));
}

// An operator whose motions of the last 0.3 s carry on for 0.2 s and then stop.
TEST(DisplacementRegressionTest, LearnsTheWeightsOfTheVelocities) {
  Random random(1);
  Regression regression(kSecondsAhead, kPriorSpeed);
  for (int i = 0; i < 2000; ++i) {
    const Regression::Velocities velocities = anyVelocities(random, 0.3);
    learn(regression, velocities, 0.2 * velocities.col(2));
  }
  EXPECT_LT((regression.weights() - 0.2 * Regression::Weights::Unit(2)).norm(), 1e-3);
}

// One wild displacement among many, of 100 times their size.
TEST(DisplacementRegressionTest, AnOutlierTeachesLittle) {
  Random random(5);
  Regression regression(kSecondsAhead, kPriorSpeed);
  const auto moved = [&](const auto& velocities) -> Eigen::Vector3d {
    return 0.2 * velocities.col(2) + 0.005 * random.direction();
  };
  for (int i = 0; i < 1000; ++i) {
    const Regression::Velocities velocities = anyVelocities(random, 0.3);
    learn(regression, velocities, moved(velocities));
  }
  const Regression::Weights before = regression.weights();
  const Regression::Velocities velocities = anyVelocities(random, 0.3);
  learn(regression, velocities, 100.0 * moved(velocities));
  EXPECT_LT((regression.weights() - before).norm(), 0.002);
}

// Two observations of large errors: what is expected counts, here of two regressions that differ in nothing else.
TEST(DisplacementRegressionTest, LeansTowardsWhatIsExpectedWhileItKnowsLittle) {
  const auto weights = [](const Regression::Weights& expected) {
    Random random(6);
    Regression regression(kSecondsAhead, kPriorSpeed);
    for (int i = 0; i < 2; ++i) regression.learn(anyVelocities(random, 0.3), random.direction(), kPeriod, expected);
    return regression.weights();
  };
  const Regression::Weights difference =
      weights(0.3 * Regression::Weights::Unit(1)) - weights(Regression::Weights::Zero());
  EXPECT_GT(difference[1], 0.05);
  EXPECT_LT((difference - difference[1] * Regression::Weights::Unit(1)).norm(), 0.02);
}

TEST(DisplacementRegressionTest, FollowsAnOperatorWhoChanges) {
  Random random(2);
  Regression regression(kSecondsAhead, kPriorSpeed);
  for (int i = 0; i < 20000; ++i) {
    const Regression::Velocities velocities = anyVelocities(random, 0.3);
    learn(regression, velocities, (i < 10000 ? 0.5 : 0.1) * velocities.col(0));
  }
  EXPECT_NEAR(regression.weights()[0], 0.1, 0.01);
}

// Velocities that say nothing of where the tool goes: to hold still errs least.
TEST(DisplacementRegressionTest, PredictsNoMotionWhereVelocitiesMislead) {
  Random random(3);
  Regression regression(kSecondsAhead, kPriorSpeed);
  for (int i = 0; i < 3000; ++i) learn(regression, anyVelocities(random, 1.0), 0.05 * random.direction());
  EXPECT_LT(regression.weights().norm(), 0.02);
}

// Noise about a tool at rest, and then it goes: what was learned from the noise must not be blown up by the motion.
TEST(DisplacementRegressionTest, DoesNotExplodeWhenRestEnds) {
  Random random(4);
  Regression regression(kSecondsAhead, kPriorSpeed);
  for (int i = 0; i < 300; ++i) learn(regression, anyVelocities(random, 1e-4), 1e-5 * random.direction());
  for (int i = 0; i < 50; ++i) {
    learn(regression, anyVelocities(random, 1e-4), Eigen::Vector3d(0.1 * i / 50, 0.0, 0.0));
    EXPECT_LT(regression.weights().cwiseAbs().maxCoeff(), 3.0 * kSecondsAhead);
  }
}

}  // namespace
}  // namespace sweep_guard_core
