#include "prediction/polynomial_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "prediction/predictors.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

constexpr Duration kWindow = milliseconds(300);

// Value i is a polynomial of degree i in time, in [m].
Vector6d staircase(double t) {
  Vector6d values;
  values << 0.3, 0.1 - 0.2 * t, 0.5 * t * t - t, t * t * t - 0.2 * t, std::pow(t, 4) - t * t, 0.1 * std::pow(t, 5) + t;
  return values;
}

PolynomialFit<6> fitOf(const std::function<Vector6d(double)>& truth, int degree, double until, double period,
                       double forgetting_factor = 0.98) {
  PolynomialFit<6> fit(degree, kWindow, forgetting_factor);
  for (int i = 0; i * period <= until; ++i) fit.add(at(i * period), truth(i * period));
  return fit;
}

// A noise-free polynomial lies in the model, so the fit must return it, also a second ahead of the newest sample.
TEST(PolynomialFitTest, ReturnsPolynomialsOfEveryDegree) {
  const auto curve = fitOf(staircase, 5, 2.0, 0.01).curve({0, 1, 2, 3, 4, 5});
  for (const double t : {1.8, 2.0, 2.1, 2.5, 3.0}) {
    EXPECT_LT((curve.at(at(t)) - staircase(t)).cwiseAbs().maxCoeff(), 1e-9) << "at " << t << " s";
  }
}

TEST(PolynomialFitTest, TakesStampsAsTheyCome) {
  PolynomialFit<6> fit(3, kWindow, 0.95);
  double t = 0.0;
  for (int i = 0; i < 200; ++i) {
    t += i % 3 == 0 ? 0.002 : 0.017;
    fit.add(at(t), staircase(t));
  }
  const auto curve = fit.curve({0, 1, 2, 3, 3, 3});
  EXPECT_LT((curve.at(at(t + 1.0)) - staircase(t + 1.0)).head<4>().cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PolynomialFitTest, MeasuresTheSlope) {
  const auto curve = fitOf(staircase, 2, 2.0, 0.01).curve({1, 1, 2, 1, 1, 1});
  EXPECT_NEAR(curve.slopeAt(at(2.0))[1], -0.2, 1e-12);
  EXPECT_NEAR(curve.slopeAt(at(2.0))[2], 1.0, 1e-10);  // d/dt (t^2/2 - t) at 2 s
}

// What lies before the window has no weight at all, however little is forgotten.
TEST(PolynomialFitTest, ForgetsWhatIsOlderThanTheWindow) {
  const auto corner = [](double t) -> Vector6d { return Vector6d::Constant(t < 1.0 ? 5.0 * t : 5.0); };
  PolynomialFit<6> fit = fitOf(corner, 1, 1.0 + toSeconds(kWindow) + 0.01, 0.01, 1.0);
  EXPECT_NEAR(fit.curve({1, 1, 1, 1, 1, 1}).slopeAt(at(1.31))[0], 0.0, 1e-12);
  EXPECT_LE(fit.span(), kWindow);
}

TEST(PolynomialFitTest, WeighsSamplesByTheForgettingFactor) {
  PolynomialFit<6> fit(0, kWindow, 0.5);
  for (int i = 0; i < 3; ++i) fit.add(at(0.01 * i), Vector6d::Constant(i));
  EXPECT_NEAR(fit.curve({}).at(at(0.0))[0], (0.25 * 0 + 0.5 * 1 + 1.0 * 2) / 1.75, 1e-12);
}

TEST(PolynomialFitTest, LowersTheDegreeUntilThereAreSamplesForIt) {
  PolynomialFit<6> fit(3, kWindow, 1.0);
  fit.add(at(0.0), staircase(0.0));
  EXPECT_EQ(fit.curve({3, 3, 3, 3, 3, 3}).at(at(1.0)), staircase(0.0));
  fit.add(at(0.1), staircase(0.1));
  EXPECT_NEAR(fit.curve({3, 3, 3, 3, 3, 3}).at(at(1.0))[1], staircase(1.0)[1], 1e-12);
}

TEST(PolynomialFitTest, KeepsSlowSamplesThoughTheyAreOlderThanTheWindow) {
  PolynomialFit<6> fit = fitOf(staircase, 2, 10.0, 1.0);
  EXPECT_EQ(fit.size(), 3U);
  EXPECT_NEAR(fit.curve({2, 2, 2, 2, 2, 2}).at(at(11.0))[2], staircase(11.0)[2], 1e-9);
}

TEST(PolynomialFitTest, CorrectsItsNewestSample) {
  PolynomialFit<6> fit = fitOf(staircase, 1, 0.2, 0.01);
  fit.add(at(0.21), Vector6d::Constant(99.0));
  for (int i = 0; i < 1000; ++i) fit.replaceNewest(Vector6d::Constant(0.001 * i));
  fit.replaceNewest(staircase(0.21));
  EXPECT_NEAR(fit.curve({0, 1, 0, 0, 0, 0}).at(at(1.0))[1], staircase(1.0)[1], 1e-12);
}

// Hours at 1 kHz: neither errors of rounding nor the age of the clock add up, and nothing winds up while it stands
// still.
TEST(PolynomialFitTest, IsAsExactAfterTenMillionUpdatesAsAtFirst) {
  PolynomialFit<6> fit(2, milliseconds(50), 0.98);
  const auto truth = [](double t) -> Vector6d {
    return Vector6d::Constant(t < 5000.0 ? 1e3 : 1e3 + 0.01 * (t - 5000.0) * (t - 5000.0));
  };
  constexpr int kUpdates = 10000000;
  for (int i = 0; i < kUpdates; ++i) fit.add(at(0.001 * i), truth(0.001 * i));
  const double end = 0.001 * (kUpdates - 1);
  EXPECT_NEAR(fit.curve({2, 2, 2, 2, 2, 2}).slopeAt(at(end))[0], 0.02 * (end - 5000.0), 1e-4);
  fit.clear();
  for (int i = 0; i < 200; ++i) fit.add(at(end + 1.0 + 0.001 * i), staircase(0.001 * i));
  EXPECT_NEAR(fit.curve({0, 1, 2, 2, 2, 2}).at(at(end + 2.0))[2], staircase(1.0)[2], 1e-9);
}

}  // namespace
}  // namespace sweep_guard_core
