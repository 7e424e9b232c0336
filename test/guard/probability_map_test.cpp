#include "sweep_guard/guard/probability_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/floating_point.h"
#include "guard/contact_probability.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {
namespace {

class ProbabilityMapTest : public testing::TestWithParam<PredictionInterval> {};

TEST_P(ProbabilityMapTest, FallsWithTheDeviationsAndStaysWithinZeroAndOne) {
  double before = 1.0;
  for (double deviations = -kMaxDeviations; deviations <= kMaxDeviations; deviations += 0.01) {
    const double probability = probabilityWithin(GetParam(), deviations);
    EXPECT_LT(probability, before) << deviations;
    EXPECT_GT(probability, 0.0) << deviations;
    before = probability;
  }
}

TEST_P(ProbabilityMapTest, IsZeroBeyondTheLastDeviationAndConstantBeforeTheFirst) {
  EXPECT_EQ(probabilityWithin(GetParam(), kMaxDeviations + 1e-9), 0.0);
  EXPECT_EQ(probabilityWithin(GetParam(), kInfinity), 0.0);
  EXPECT_EQ(probabilityWithin(GetParam(), -kInfinity), probabilityWithin(GetParam(), -kMaxDeviations));
}

TEST_P(ProbabilityMapTest, TheInverseIsTheLargestNumberOfDeviationsWithTheProbability) {
  for (double deviations = -3.0; deviations <= 3.0; deviations += 0.37) {
    const double probability = probabilityWithin(GetParam(), deviations);
    EXPECT_NEAR(deviationsAt(GetParam(), probability), deviations, 1e-9);
    EXPECT_GE(probabilityWithin(GetParam(), deviationsAt(GetParam(), probability)), probability);
  }
  EXPECT_EQ(deviationsAt(GetParam(), 1e-6), kMaxDeviations);
  EXPECT_EQ(deviationsAt(GetParam(), 1.0), -kInfinity);
}

// The default tool meets fewer than one plane alone says: that was 1.8 to 2.8 times too often.
TEST_P(ProbabilityMapTest, IsLessThanThatOfOnePlaneBesideThePath) {
  for (const double deviations : {0.0, 0.5, 1.0, 1.5}) {
    EXPECT_LT(probabilityWithin(GetParam(), deviations), contactProbability(deviations)) << deviations;
  }
}

TEST_P(ProbabilityMapTest, AThresholdOfThePlanesScaleHasTheSameDeviations) {
  for (const double deviations : {-2.0, 0.0, 1.0, 2.5}) {
    EXPECT_NEAR(fromPlaneProbability(GetParam(), contactProbability(deviations)),
                probabilityWithin(GetParam(), deviations), 1e-9);
  }
  EXPECT_EQ(fromPlaneProbability(GetParam(), 1.0), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Intervals, ProbabilityMapTest,
                         testing::Values(PredictionInterval::kReflex, PredictionInterval::kConsidered),
                         [](const auto& test) {
                           return test.param == PredictionInterval::kReflex ? "Reflex" : "Considered";
                         });

TEST(WarningThresholdsTest, TheThresholdsOfOnePlaneDifferBetweenTheIntervals) {
  const WarningThresholds thresholds = WarningThresholds::ofMinProbability(0.1);
  EXPECT_EQ(thresholds.reflex, fromPlaneProbability(PredictionInterval::kReflex, 0.1));
  EXPECT_EQ(thresholds.considered_on, fromPlaneProbability(PredictionInterval::kConsidered, 0.1));
  EXPECT_EQ(thresholds.considered_off, thresholds.considered_on);
  EXPECT_NE(thresholds.reflex, thresholds.considered_on);
}

}  // namespace
}  // namespace sweep_guard_core
