#include "evaluation/session_tuning.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::WarningThresholds;

/// 10 min with as many unjustified alarms, and half as many right ones.
TuningPoint point(double on, size_t unjustified) {
  TuningPoint point;
  point.thresholds = {0.1, on, on / 4.0};
  point.figures.minutes = 10.0;
  point.figures.unjustified = unjustified;
  point.figures.alarms = unjustified + unjustified / 2;
  point.figures.contacts = 4;
  point.figures.warned = {4, 4, 3, 1};
  return point;
}

const std::vector<TuningPoint> kPoints = {point(0.1, 80), point(0.2, 40), point(0.3, 50), point(0.5, 20),
                                          point(1.0, 25)};

TEST(SessionTuningTest, KeepsReflexAndTheLowerThresholdUpToTheUpperOne) {
  const WarningThresholds current{0.15, 0.3, 0.04};
  const auto thresholds = tuningThresholds(current);
  EXPECT_LT(thresholds.front().considered_on, 0.04);
  for (size_t i = 0; i < thresholds.size(); ++i) {
    EXPECT_EQ(thresholds[i].reflex, 0.15);
    EXPECT_EQ(thresholds[i].considered_off, std::min(0.04, thresholds[i].considered_on));
    if (i > 0) {
      EXPECT_GT(thresholds[i].considered_on, thresholds[i - 1].considered_on);
    }
  }
}

TEST(SessionTuningTest, ChoosesTheSmallestThresholdFromWhichOnThereAreFewEnough) {
  EXPECT_EQ(choosePoint(kPoints, 10.0)->thresholds.considered_on, 0.1);
  EXPECT_EQ(choosePoint(kPoints, 5.0)->thresholds.considered_on, 0.2);
  EXPECT_EQ(choosePoint(kPoints, 4.5)->thresholds.considered_on, 0.5);  // 0.3 has more
  EXPECT_EQ(choosePoint(kPoints, 2.0)->thresholds.considered_on, 0.5);  // and so has 1.0
  EXPECT_FALSE(choosePoint(kPoints, 1.9).has_value());
}

TEST(SessionTuningTest, PrintsYamlToPasteOrTheFewest) {
  EXPECT_TRUE(has(tuningText(kPoints, 5.0),
                  "# at most 5 unjustified alarms per minute\n"
                  "warning:\n  considered_on: 0.2\n  considered_off: 0.05\n  reflex_probability: 0.1\n"));
  const std::string none = tuningText(kPoints, 1.0);
  EXPECT_TRUE(has(none, "the fewest are 2.00"));
  EXPECT_FALSE(has(none, "warning:"));
}

TEST(SessionTuningTest, SharesOfNothingAreNoNumbers) {
  TuningPoint nothing = point(0.1, 0);
  nothing.figures = {};
  nothing.figures.minutes = 10.0;
  EXPECT_FALSE(has(tuningText({nothing}, 5.0), "nan"));
}

TEST(SessionTuningTest, WritesTheCurve) {
  EXPECT_TRUE(has(tuningCsv(kPoints, 5.0), "\n0.2,0.05,0.1,4,0.333333,1,1,0.75,0.25,0,0,5\n"));
}

}  // namespace
}  // namespace sweep_guard_evaluation
