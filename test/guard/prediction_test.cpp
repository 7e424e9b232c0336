#include "sweep_guard/guard/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/floating_point.h"
#include "guard/contact_probability.h"
#include "monitor/warnings.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const Workpiece> workpiece(const std::string& id) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  return std::make_shared<const Workpiece>(Workpiece{id, 1, Time(1s), SteadyTime(1s), "table", mesh});
}

// Three sweeps of 100 ms.
PredictedObject object(const std::string& id, const std::vector<PredictedSweep>& sweeps) {
  return {workpiece(id), sweeps, {}, {}, {}};
}

const PredictedSweep kFree0{0ms};
const PredictedSweep kFree1{100ms};
const PredictedSweep kFree2{200ms};

Prediction predictionWith(const std::vector<PredictedObject>& objects) {
  Prediction prediction;
  prediction.stamp = Time(5s);
  prediction.path.resize(3);
  for (int i = 0; i < 3; ++i) prediction.path[static_cast<size_t>(i)].ahead = (i + 1) * 100ms;
  prediction.reflex_sweeps = 1;
  prediction.objects = objects;
  return prediction;
}

PredictedContact contactOf(const std::vector<PredictedObject>& objects, std::optional<double> deviations = 1.0) {
  return predictedContact(predictionWith(objects), deviations).value();
}

TEST(PredictionTest, CoversThePathOnlyIfEveryWorkpieceWasTested) {
  Prediction prediction = predictionWith({object("liver", {kFree0, kFree1, kFree2})});
  EXPECT_EQ(prediction.coveredUntil(), Time(5300ms));
  prediction.unplaced = {workpiece("spleen")};
  EXPECT_EQ(prediction.coveredUntil(), Time(5s));
  prediction.unplaced.clear();
  prediction.failures = {{workpiece("spleen"), "no canary"}};
  EXPECT_EQ(prediction.coveredUntil(), Time(5s));
  prediction.failures.clear();
  prediction.path.clear();
  EXPECT_EQ(prediction.coveredUntil(), Time(5s));
}

TEST(PredictionTest, IsCompleteOnlyWithAPathAndAWorkpieceAndEveryWorkpieceTested) {
  const Prediction complete = predictionWith({object("liver", {kFree0, kFree1, kFree2})});
  EXPECT_TRUE(complete.complete());
  EXPECT_FALSE(predictionWith({}).complete());
  Prediction prediction = complete;
  prediction.unplaced = {workpiece("spleen")};
  EXPECT_FALSE(prediction.complete());
  prediction = complete;
  prediction.failures = {{workpiece("spleen"), "no canary"}};
  EXPECT_FALSE(prediction.complete());
  prediction = complete;
  prediction.path.clear();
  EXPECT_FALSE(prediction.complete());
}

TEST(PredictionTest, IsAsProbableAsTheNearestSweepThatBeginsWithinTheInterval) {
  EXPECT_EQ(predictionWith({}).probability(PredictionInterval::kConsidered, 1s), 0.0);
  const Prediction prediction = predictionWith({object("liver", {kFree0, {100ms, false, 0.5}, kFree2}),
                                                object("spleen", {kFree0, {100ms, false, 1.0}, {200ms, true, -0.5}})});
  for (const auto interval : {PredictionInterval::kReflex, PredictionInterval::kConsidered}) {
    EXPECT_EQ(prediction.probability(interval, 100ms), 0.0);
    EXPECT_EQ(prediction.probability(interval, 200ms), probabilityWithin(interval, 0.5));
    EXPECT_EQ(prediction.probability(interval, 201ms), probabilityWithin(interval, -0.5));
  }
}

TEST(PredictionTest, IsMetWhereThePathFirstMeetsAnyWorkpiece) {
  EXPECT_FALSE(predictionWith({}).firstContact());
  EXPECT_FALSE(predictionWith({object("liver", {{0ms, false, 0.25}, kFree1, kFree2})}).firstContact());
  EXPECT_EQ(predictionWith({object("liver", {{0ms, false, 0.25}, kFree1, kFree2}),
                            object("spleen", {kFree0, kFree1, {205ms, true, -1.0}}),
                            object("kidney", {kFree0, {103ms, true, -0.25}, {205ms, true, -1.0}})})
                .firstContact(),
            103ms);
}

TEST(PredictedContactTest, IsNoneWhereNoContactIsCertainOrProbable) {
  EXPECT_FALSE(predictedContact(predictionWith({}), 1.0));
  EXPECT_FALSE(predictedContact(predictionWith({object("liver", {kFree0, kFree1, kFree2})}), 1.0));
  EXPECT_FALSE(predictedContact(predictionWith({object("liver", {kFree0, {100ms, false, 1.0001}, kFree2})}), 1.0));
}

TEST(PredictedContactTest, IsTheEarliestOfAllWorkpieces) {
  const PredictedContact predicted = contactOf({object("liver", {kFree0, kFree1, {210ms, true, -1.0}}),
                                                object("spleen", {kFree0, {150ms, true, -0.75}, kFree2})});
  EXPECT_EQ(predicted.mesh_id, "spleen");
  EXPECT_EQ(predicted.earliest(), Time(5150ms));
  EXPECT_EQ(predicted.contact, Time(5150ms));
  EXPECT_EQ(predicted.considered_probability, probabilityWithin(PredictionInterval::kConsidered, -0.75));
}

TEST(PredictedContactTest, MayBeMerelyProbable) {
  const PredictedContact predicted = contactOf({object("liver", {kFree0, {100ms, false, 1.0}, {200ms, false, 0.5}})});
  EXPECT_EQ(predicted.earliest(), Time(5100ms));
  EXPECT_FALSE(predicted.contact);
  EXPECT_EQ(predicted.considered_probability, probabilityWithin(PredictionInterval::kConsidered, 0.5));
  EXPECT_TRUE(predicted.triangles.empty());
}

// Probable first, met later: one collision, which may begin with the former and has the triangles of the latter.
TEST(PredictedContactTest, ReportsWhenThePathMeetsTheWorkpieceLater) {
  PredictedObject liver = object("liver", {kFree0, {100ms, false, 0.75}, {205ms, true, -1.0}});
  liver.reflex = {1, 7};
  liver.considered = {3};
  const PredictedContact predicted = contactOf({liver});
  EXPECT_EQ(predicted.earliest(), Time(5100ms));
  EXPECT_EQ(predicted.contact, Time(5205ms));
  EXPECT_EQ(predicted.considered_probability, probabilityWithin(PredictionInterval::kConsidered, -1.0));
  EXPECT_EQ(predicted.triangles, (std::vector<std::uint32_t>{1, 3, 7}));
}

// What is merely probable before it is met is one collision with it: the piece is the one that the time and the
// triangles are of.
TEST(PredictedContactTest, NamesTheToolPieceThatMeetsFirst) {
  const PredictedContact predicted =
      contactOf({object("liver", {{0ms, false, 0.75, 0}, {100ms, true, -1.0, 1}, {200ms, true, -1.0, 2}})});
  EXPECT_EQ(predicted.earliest(), Time(5000ms));
  EXPECT_EQ(predicted.tool_piece, 1U);
}

TEST(PredictedContactTest, NamesTheNearestToolPieceWhereNoneMeets) {
  const PredictedContact predicted =
      contactOf({object("liver", {kFree0, {100ms, false, 0.75, 3}, {200ms, false, 0.5, 1}}),
                 object("spleen", {kFree0, kFree1, {200ms, false, 0.0, 2}})});
  EXPECT_EQ(predicted.tool_piece, 3U);
}

// A path that meets is reported however far its volume is.
TEST(PredictedContactTest, APathThatMeetsNeedsNoProbability) {
  EXPECT_TRUE(contactOf({object("liver", {{0ms, true}, kFree1, kFree2})}, std::nullopt).contact);
}

// What comes after an interval adds nothing to its probability, but what is warned of is in it.
TEST(PredictedContactTest, HasAProbabilityForEachInterval) {
  const Prediction prediction =
      predictionWith({object("liver", {{0ms, false, 2.0}, {100ms, false, 1.0}, {200ms, false, 0.5}})});
  const auto contactAt = [&](double deviations) {
    const double reflex = probabilityWithin(PredictionInterval::kReflex, deviations);
    const double considered = probabilityWithin(PredictionInterval::kConsidered, deviations);
    std::optional<PredictedContact> contact;
    findPredictedContact(prediction, prediction.objects[0], {prediction.stamp, {}}, {reflex, considered, 100ms, 200ms},
                         contact);
    return contact.value();
  };
  EXPECT_EQ(contactAt(2.0).reflex_probability, probabilityWithin(PredictionInterval::kReflex, 2.0));
  EXPECT_EQ(contactAt(2.0).considered_probability, probabilityWithin(PredictionInterval::kConsidered, 1.0));
  EXPECT_EQ(contactAt(0.5).reflex_probability, probabilityWithin(PredictionInterval::kReflex, 0.5));
  EXPECT_EQ(contactAt(0.5).considered_probability, probabilityWithin(PredictionInterval::kConsidered, 0.5));
}

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
