#include "evaluation/calibration.h"

#include <gtest/gtest.h>

#include "evaluation/calibration_report.h"
#include "evaluation/motions.h"
#include "evaluation/random.h"
#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::PredictionInterval;

std::vector<PredictionOutcome> times(size_t count, double probability, size_t met) {
  std::vector<PredictionOutcome> forecasts(count, {0.0, false, probability});
  for (size_t i = 0; i < met; ++i) forecasts[i].met = true;
  return forecasts;
}

std::vector<PredictionOutcome> joined(std::vector<PredictionOutcome> a, const std::vector<PredictionOutcome>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(CalibrationTest, HonestForecastsHaveNoError) {
  std::vector<PredictionOutcome> forecasts;
  for (int bin = 0; bin < 5; ++bin) forecasts = joined(forecasts, times(100, 0.1 + 1e-12 * bin, 10));
  for (int bin = 0; bin < 5; ++bin) forecasts = joined(forecasts, times(100, 0.5 + 1e-12 * bin, 50));
  const Calibration honest = calibrationOf(forecasts);
  ASSERT_EQ(honest.bins.size(), kBins);
  EXPECT_NEAR(honest.error, 0.0, 1e-9);
  EXPECT_NEAR(honest.ratio, 1.0, 1e-9);
  EXPECT_NEAR(honest.brier, 0.5 * (0.1 * 0.9 + 0.5 * 0.5), 1e-9);
  EXPECT_NEAR(honest.skill, 1.0 - honest.brier / (0.3 * 0.7), 1e-9);
}

// Each bin of 100 has its own frequency: the first half 0.02 instead of 0.1, the other 0.4 instead of 0.5.
TEST(CalibrationTest, TheErrorIsTheMeanDifferenceOverTheBins) {
  std::vector<PredictionOutcome> forecasts;
  for (int bin = 0; bin < 5; ++bin) forecasts = joined(forecasts, times(100, 0.1 + 1e-6 * bin, 2));
  for (int bin = 0; bin < 5; ++bin) forecasts = joined(forecasts, times(100, 0.5 + 1e-6 * bin, 40));
  const Calibration calibration = calibrationOf(forecasts);
  EXPECT_NEAR(calibration.error, 0.5 * 0.08 + 0.5 * 0.1, 1e-5);
  EXPECT_NEAR(calibration.bins.front().frequency, 0.02, 1e-12);
  EXPECT_NEAR(calibration.bins.back().frequency, 0.4, 1e-12);
  EXPECT_EQ(calibration.bins.front().count, 100U);
  EXPECT_NEAR(calibration.ratio, 0.3 / 0.21, 1e-4);
}

TEST(CalibrationTest, SmallForecastsDoNotCount) {
  EXPECT_EQ(calibrationOf(joined(times(500, 0.0099, 50), times(40, 0.01, 4))).count(), 40U);
}

/// Outcomes whose frequency falls from 1 to 0 in a straight line between -1 and 1.
std::vector<PredictionOutcome> fallingOutcomes() {
  Random random(3);
  std::vector<PredictionOutcome> outcomes;
  for (int i = 0; i < 50000; ++i) {
    const double deviations = random.uniform(-3.0, 3.0);
    outcomes.push_back({deviations, random.uniform(-1.0, 1.0) > deviations});
  }
  return outcomes;
}

TEST(CalibrationTest, TheFitFindsAFallingFrequency) {
  const auto knots = fitProbability(fallingOutcomes());
  for (const double deviations : {-1.0, -0.6, 0.0, 0.3, 0.8}) {
    EXPECT_NEAR(probabilityAt(knots, deviations), 0.5 * (1.0 - deviations), 0.02) << deviations;
  }
  EXPECT_EQ(probabilityAt(knots, 3.1), 0.0);
}

// Contacts that come the more often the farther away are noise to it.
TEST(CalibrationTest, TheFitFallsEvenWhereTheFrequencyRises) {
  std::vector<PredictionOutcome> outcomes;
  for (int i = 0; i < 1000; ++i) outcomes.push_back({-2.0 + 0.004 * i, i % 1000 > 500});
  const auto knots = fitProbability(outcomes);
  for (size_t k = 1; k < knots.size(); ++k) EXPECT_LT(knots[k], knots[k - 1]) << k;
}

/// A motion of 4 s with a pose every 10 ms, and an object that is touched from 2 s to 2.5 s.
class OutcomesTest : public testing::Test {
 protected:
  std::vector<PredictionOutcome> outcomes(Duration interval) const {
    return outcomesOf(motion_, findings_, 0, touches_, interval);
  }

  static Time at(int ms) { return Time(milliseconds(ms)); }

  void find(int ms, const std::vector<sweep_guard_core::PredictedSweep>& sweeps) {
    ObjectFindings& object = findings_.objects[0];
    object.sweeps.insert(object.sweeps.end(), sweeps.begin(), sweeps.end());
    object.poses.push_back({static_cast<size_t>(ms / 10), false, object.sweeps.size()});
  }

  OutcomesTest() {
    findings_.objects.resize(1);
    for (const auto& pose : motion_.poses()) findings_.stamps.push_back(pose.stamp);
  }

  RecordedMotion motion_{straightMotion(0.1, milliseconds(10), std::chrono::seconds(4))};
  GuardFindings findings_;
  std::vector<TimeInterval> touches_ = {{at(2000), at(2500)}};
};

TEST_F(OutcomesTest, AreMetIfATouchBeginsWithinTheInterval) {
  find(1000, {{milliseconds(0), false, 2.0}, {milliseconds(500), false, 0.5}, {milliseconds(1000), true, -1.0}});
  find(1500, {{milliseconds(0), false, 1.0}});
  ASSERT_EQ(outcomes(milliseconds(1000)).size(), 2U);
  EXPECT_TRUE(outcomes(milliseconds(1000))[0].met);
  EXPECT_EQ(outcomes(milliseconds(1000))[0].deviations, 0.5);
  EXPECT_FALSE(outcomes(milliseconds(400))[0].met);
  EXPECT_EQ(outcomes(milliseconds(400))[0].deviations, 2.0);
  EXPECT_TRUE(outcomes(milliseconds(500))[1].met);
}

TEST_F(OutcomesTest, LeaveOutWhatSaysNothing) {
  find(2100, {{milliseconds(0), true, -1.0}});  // touches
  find(2600, {{milliseconds(100), false, 1.0}});
  find(2620, {{milliseconds(0), false, 0.7}});    // comes sooner than 50 ms later
  find(2700, {{milliseconds(600), false, 1.0}});  // only beyond the interval
  find(3700, {{milliseconds(0), false, 1.0}});    // is not recorded to its end
  const auto left = outcomes(milliseconds(500));
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].deviations, 1.0);
  EXPECT_FALSE(left[0].met);
}

TEST(CalibrationReportTest, EachRecordingIsJudgedByWhatTheOthersTeach) {
  IntervalCalibration calibration{PredictionInterval::kConsidered, std::chrono::seconds(1), {"a", "b"}, {}};
  calibration.outcomes = {fallingOutcomes(), fallingOutcomes()};
  for (PredictionOutcome& outcome : calibration.outcomes[1]) outcome.met = false;
  const Calibration of_a = calibrationOf(calibration.forecasts(Scale::kOthers, 0));
  EXPECT_LT(of_a.ratio, 0.1);  // b was never met
  EXPECT_GT(calibrationOf(calibration.forecasts(Scale::kOthers, 1)).bins.back().probability, 0.9);
  const std::string table = calibrationTable({calibration});
  for (const char* const word :
       {"within 1 s", "one plane", "the guard", "fitted to the other recordings", "{-3.09, "}) {
    EXPECT_TRUE(has(table, word)) << word;
  }
}

}  // namespace
}  // namespace sweep_guard_evaluation
