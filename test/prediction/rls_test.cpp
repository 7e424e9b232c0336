#include "prediction/rls.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Fit = Rls<3, 2>;

const Eigen::Matrix<double, 3, 2> kTruth = (Eigen::Matrix<double, 3, 2>() << 1.0, -2.0, 0.5, 0.0, 3.0, 0.25).finished();

Fit::Regressors anyRegressors(Random& random) { return random.inBox({1.0, 1.0, 1.0}); }

Fit noiseFreeFit(std::uint64_t seed, int observations) {
  Random random(seed);
  Fit fit;
  for (int i = 0; i < observations; ++i) {
    const Fit::Regressors regressors = anyRegressors(random);
    fit.add(regressors, kTruth.transpose() * regressors);
  }
  return fit;
}

TEST(RlsTest, FindsTheCoefficientsOfNoiseFreeObservations) {
  const Fit fit = noiseFreeFit(/*seed=*/1, /*observations=*/10);
  EXPECT_LT((fit.coefficients() - kTruth).norm(), 1e-12);
}

// The batch solution of the weighted normal equations is what the recursion must arrive at.
TEST(RlsTest, AgreesWithTheBatchSolution) {
  Random random(2);
  constexpr double kFactor = 0.9;
  Eigen::MatrixXd regressors(20, 3);
  Eigen::MatrixXd outputs(20, 2);
  Fit fit;
  for (int i = 0; i < 20; ++i) {
    regressors.row(i) = anyRegressors(random);
    outputs.row(i) << random.uniform(-1, 1), random.uniform(-1, 1);
    fit.forget(kFactor);
    fit.add(regressors.row(i).transpose(), outputs.row(i).transpose());
  }
  Eigen::VectorXd root_weights(20);
  for (int i = 0; i < 20; ++i) root_weights[i] = std::pow(kFactor, (19 - i) / 2.0);
  const Eigen::MatrixXd batch = (root_weights.asDiagonal() * regressors)
                                    .colPivHouseholderQr()
                                    .solve(Eigen::MatrixXd(root_weights.asDiagonal() * outputs));
  EXPECT_LT((fit.coefficients() - batch).norm(), 1e-12);
}

TEST(RlsTest, TakesAnObservationOutAgain) {
  Fit fit = noiseFreeFit(/*seed=*/3, /*observations=*/6);
  const Fit::Regressors outlier(1.0, 2.0, 3.0);
  fit.add(outlier, Fit::Outputs(50.0, -50.0));
  EXPECT_GT((fit.coefficients() - kTruth).norm(), 1.0);
  fit.add(outlier, Fit::Outputs(50.0, -50.0), -1.0);
  EXPECT_LT((fit.coefficients() - kTruth).norm(), 1e-10);
}

TEST(RlsTest, ThePriorDrawsToZeroWhatIsNotObserved) {
  Fit fit;
  fit.add({1.0, 0.0, 0.0}, Fit::Outputs(2.0, 4.0));
  const auto coefficients = fit.coefficients(3, 1.0);
  EXPECT_NEAR(coefficients(0, 0), 1.0, 1e-12);  // half way: one observation against a prior of the same weight
  EXPECT_EQ(coefficients(1, 0), 0.0);
  EXPECT_EQ(coefficients(2, 1), 0.0);
}

TEST(RlsTest, ThePriorDrawsToWhatIsExpected) {
  Fit fit;
  fit.add({1.0, 0.0, 0.0}, Fit::Outputs(2.0, 4.0));
  Fit::Coefficients expected = Fit::Coefficients::Constant(3, 2, 5.0);
  const auto coefficients = fit.coefficients(1.0, expected);
  EXPECT_NEAR(coefficients(0, 0), 3.5, 1e-12);
  EXPECT_NEAR(coefficients(0, 1), 4.5, 1e-12);
  EXPECT_NEAR(coefficients(2, 1), 5.0, 1e-12);
}

// What is forgotten while nothing moves falls back to the prior: the estimate does not blow up.
TEST(RlsTest, FallsBackToThePriorWhileNothingMoves) {
  Fit fit = noiseFreeFit(/*seed=*/4, /*observations=*/100);
  for (int i = 0; i < 100000; ++i) {
    fit.forget(0.99);
    fit.add(Fit::Regressors::Zero(), Fit::Outputs::Zero());
  }
  EXPECT_LT(fit.coefficients(3, 1e-6).norm(), 1e-9);
}

TEST(RlsTest, StaysAccurateOverAMillionObservations) {
  Random random(5);
  Fit fit;
  for (int i = 0; i < 1000000; ++i) {
    const Fit::Regressors regressors = anyRegressors(random);
    fit.forget(0.999);
    fit.add(regressors, kTruth.transpose() * regressors);
  }
  EXPECT_LT((fit.coefficients() - kTruth).norm(), 1e-12);
}

}  // namespace
}  // namespace sweep_guard_core
