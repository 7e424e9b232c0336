#include "monitor/warning_monitor_fixture.h"

namespace sweep_guard_core {
namespace {

// No prediction comes between, only time.
TEST_F(WarningMonitorTest, AWarningRisesByItself) {
  predict(collisionOn(workpieces_, 1000, 1050), 1000);
  EXPECT_EQ(levelAt(1034), WarningLevel::kClear);
  EXPECT_EQ(levelAt(1035), WarningLevel::kConsidered);
  EXPECT_EQ(levelAt(1934), WarningLevel::kConsidered);
  EXPECT_EQ(levelAt(1935), WarningLevel::kReflex);
  const Warning warning = warningOf(monitor_, at(1100));
  EXPECT_EQ(warning.time_to_collision, milliseconds(950));
  EXPECT_EQ(warning.probability, probabilityWithin(PredictionInterval::kConsidered, kMeeting));
  EXPECT_EQ(warning.probability_interval, kLimits.considered);
  EXPECT_EQ(warning.mesh_id, "liver");
  EXPECT_EQ(warning.triangles, (std::vector<std::uint32_t>{4}));
}

TEST_F(WarningMonitorTest, AWarningIsHeldFromWhenALaterPredictionIsFree) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  EXPECT_EQ(levelAt(1000), WarningLevel::kReflex);
  sweep(reportOf(workpieces_), 1090);
  EXPECT_FALSE(warningOf(monitor_, at(1090)).time_to_collision);
  for (int ms = 1100; ms <= 1590; ms += 10) {
    sweep(reportOf(workpieces_), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kReflex) << ms;
  }
  EXPECT_NE(levelAt(1591), WarningLevel::kReflex);
}

// Farther off than before: what was urgent is held, then what is less so.
TEST_F(WarningMonitorTest, AReflexWarningIsHeldWhileAConsideredOneLasts) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  for (int ms = 1010; ms <= 1510; ms += 10) {
    sweepOnly(reportOf(workpieces_), ms);
    predict(collisionOn(workpieces_, ms, 500), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kReflex) << ms;
  }
  EXPECT_EQ(levelAt(1511), WarningLevel::kConsidered);
}

// A later one may have been over before: the prediction from a pose that was old when it came.
TEST_F(WarningMonitorTest, AHeldWarningIsNotCutShortByALaterOneThatEndedBefore) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  sweep(reportOf(workpieces_), 1600);
  monitor_.predicted(collisionOn(workpieces_, 300, 100), timestampsAt(300), monitor_.checkpoint(), at(1600));
  sweep(reportOf(workpieces_), 1600);
  EXPECT_EQ(levelAt(2100), WarningLevel::kReflex);
  EXPECT_NE(levelAt(2101), WarningLevel::kReflex);
}

TEST_F(WarningMonitorTest, APredictedContactThatWasNeverDueIsNotHeld) {
  predict(collisionOn(workpieces_, 1000, 1050), 1000);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, APredictedContactStaysWhileItsWorkpieceCannotBeTested) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  Prediction failed = predictionFrom({}, 1010);
  failed.failures.push_back({workpieces_[0], "no canary"});
  predict(failed, 1010);
  EXPECT_EQ(warningOf(monitor_, at(1010)).time_to_collision, milliseconds(90));
  EXPECT_EQ(levelAt(1000 + 1100 + 500), WarningLevel::kReflex);  // to the end of its prediction, and held
  EXPECT_EQ(levelAt(1000 + 1100 + 501), WarningLevel::kUnknown);
  monitor_.setWorkpieces({});
  predict(failed, 1020);  // it has been removed
  EXPECT_FALSE(warningOf(monitor_, at(1020)).time_to_collision);
}

TEST_F(WarningMonitorTest, APredictedContactThatCannotBeTestedDoesNotHideAnEarlierOne) {
  const Workpieces two = {workpiece("spleen", 1000), workpieces_[0]};
  monitor_.setWorkpieces(two);
  predict(collisionOn(two, 1000, 300), 1000);
  predict(collisionOn(workpieces_, 1010, 100), 1010);
  EXPECT_EQ(warningOf(monitor_, at(1010)).mesh_id, "liver");
  EXPECT_EQ(warningOf(monitor_, at(1010)).time_to_collision, milliseconds(100));
}

// Once the prediction is over that the first was expected by, the second is warned of however long the first is lost.
TEST_F(WarningMonitorTest, APredictedContactThatCannotBeTestedDoesNotHideALaterOneForever) {
  const Workpieces two = {workpiece("spleen", 1000), workpieces_[0]};
  monitor_.setWorkpieces(two);
  predict(collisionOn(two, 1000, 100), 1000);
  for (int ms = 1010; ms <= 5000; ms += 10) {
    const int left = 4500 - ms;
    if (left <= 0) break;
    sweepOnly(reportOf(workpieces_), ms);
    predict(collisionOn(workpieces_, ms, left), ms);
    if (ms > 1000 + 1100 + 500) {
      ASSERT_EQ(levelAt(ms) >= WarningLevel::kConsidered, left <= 1015) << ms;
      ASSERT_EQ(levelAt(ms) == WarningLevel::kReflex, left <= 115) << ms;
    }
  }
  EXPECT_EQ(warningOf(monitor_, at(4490)).mesh_id, "liver");
}

TEST_F(WarningMonitorTest, EachIntervalHasAThresholdOfItsOwn) {
  for (const auto& [after_ms, threshold, level] : {std::tuple(100, kReflexAt, WarningLevel::kReflex),
                                                   std::tuple(500, kConsideredOnAt, WarningLevel::kConsidered)}) {
    monitor_.restart();
    sweepOnly(reportOf(workpieces_), 1000);
    predict(probableOn(workpieces_, 1000, after_ms, threshold + 1e-9), 1000);
    EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
    predict(probableOn(workpieces_, 1000, after_ms, threshold), 1000);
    EXPECT_EQ(levelAt(1000), level);
  }
}

TEST_F(WarningMonitorTest, AConsideredWarningStaysDownToALowerProbability) {
  for (int ms = 1000; ms < 3000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, ms == 1000 ? kConsideredOnAt : kConsideredOffAt), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kConsidered) << ms;
  }
  for (int ms = 3000; ms < 4000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kConsideredOffAt + 1e-9), ms);
    ASSERT_EQ(levelAt(ms), ms <= 3500 ? WarningLevel::kConsidered : WarningLevel::kClear) << ms;
  }
  predict(probableOn(refresh(3990), 3990, 500, kConsideredOnAt + 1e-9), 3990);
  EXPECT_EQ(levelAt(3990), WarningLevel::kClear);
}

// The path meets it first; what is left is doubt.
TEST_F(WarningMonitorTest, AWarningThatThePathRaisedStaysDownToALowerProbability) {
  predict(collisionOn(workpieces_, 1000, 500), 1000);
  for (int ms = 1010; ms < 2000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kConsideredOffAt), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kConsidered) << ms;
  }
}

TEST_F(WarningMonitorTest, WhatKeepsAWarningUpRaisesNoneOfAnotherWorkpiece) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  predict(probableOn(two, 1000, 500, kConsideredOnAt), 1000);
  const double between = 0.5 * (kConsideredOnAt + kConsideredOffAt);
  for (int ms = 1010; ms < 2000; ms += 10) {
    const Workpieces fresh = {workpiece("liver", ms), workpiece("spleen", ms)};
    monitor_.setWorkpieces(fresh);
    sweepOnly(reportOf(fresh), ms);
    Prediction prediction = predictionFrom(fresh, ms);
    prediction.objects[1].sweeps[1] = {milliseconds(500), /*contact=*/false, between};
    predict(prediction, ms);
    ASSERT_EQ(levelAt(ms), ms <= 1510 ? WarningLevel::kConsidered : WarningLevel::kClear) << ms;
    ASSERT_EQ(warningOf(monitor_, at(ms)).mesh_id, ms <= 1510 ? "liver" : "") << ms;
  }
}

// It was the lower threshold that found it, and the warning was over.
TEST_F(WarningMonitorTest, WhatIsLessProbableBeyondTheIntervalDoesNotRiseByItself) {
  predict(probableOn(workpieces_, 1000, 500, kConsideredOnAt), 1000);
  predict(probableOn(workpieces_, 1010, 1050, kConsideredOffAt), 1010);
  EXPECT_EQ(levelAt(1510), WarningLevel::kConsidered);
  EXPECT_NE(levelAt(1511), WarningLevel::kConsidered);
}

TEST_F(WarningMonitorTest, AWarningThatEndedWithItsPredictionIsNotKeptUpByLess) {
  predict(probableOn(workpieces_, 1000, 500, kConsideredOnAt), 1000);
  predict(probableOn(refresh(5000), 5000, 500, kConsideredOffAt), 5000);
  EXPECT_EQ(levelAt(5000), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, AnUrgentContactThatIsUnlikelyIsNoReflex) {
  predict(probableOn(workpieces_, 1000, 500, kConsideredOnAt), 1000);
  predict(probableOn(workpieces_, 1010, 100, kReflexAt + 1e-9), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kConsidered);
}

// Both are predicted to be met; the urgent one is named, and each has a time of its own.
TEST_F(WarningMonitorTest, OfTwoPredictedContactsTheUrgentOneIsNamedUntilItIsOver) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  Prediction prediction = collisionOn(two, 1000, 500);
  prediction.objects[1].sweeps[1] = {milliseconds(300), /*contact=*/true, kMeeting};
  predict(prediction, 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).mesh_id, "spleen");
  EXPECT_EQ(warningOf(monitor_, at(1000)).time_to_collision, milliseconds(300));
  predict(collisionOn(two, 1000, 500), 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).mesh_id, "liver");
  EXPECT_EQ(warningOf(monitor_, at(1000)).time_to_collision, milliseconds(500));
}

TEST_F(WarningMonitorTest, TheWarningOfAWorkpieceThatIsGoneIsHeldAndForgotten) {
  predict(collisionOn(workpieces_, 1000, 500), 1000);
  monitor_.setWorkpieces({});
  predict(predictionFrom({}, 1010), 1010);
  EXPECT_EQ(levelAt(1510), WarningLevel::kConsidered);
  EXPECT_EQ(levelAt(1511), WarningLevel::kUnknown);
}

// The name may stand for another workpiece now, whose warning begins at the upper threshold.
TEST_F(WarningMonitorTest, AWorkpieceThatComesAgainIsNotKeptWarnedOfByLess) {
  predict(probableOn(workpieces_, 1000, 500, kConsideredOnAt), 1000);
  monitor_.setWorkpieces({});
  predict(predictionFrom({}, 1010), 1010);
  for (int ms = 1020; ms < 2000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kConsideredOffAt), ms);
    ASSERT_EQ(levelAt(ms), ms <= 1510 ? WarningLevel::kConsidered : WarningLevel::kClear) << ms;
  }
}

TEST_F(WarningMonitorTest, APredictedContactIsHeldFromWhenItWasNoLongerPredicted) {
  predict(collisionOn(workpieces_, 1000, 500), 1000);
  EXPECT_FALSE(warningOf(monitor_, at(1000)).held_since);
  predict(predictionFrom(workpieces_, 1010), 1010);
  EXPECT_EQ(warningOf(monitor_, at(1200)).held_since, at(1010).stamp);
  EXPECT_EQ(levelAt(1511), WarningLevel::kUnknown);
  EXPECT_FALSE(warningOf(monitor_, at(1511)).held_since);
}

class AcknowledgedTest : public WarningMonitorTest {
 protected:
  AcknowledgedTest() { warnAt(1000); }

  void warnAt(int ms, int after_ms = 500) { predict(collisionOn(refresh(ms), ms, after_ms), ms); }
  std::string acknowledge(int ms) { return monitor_.acknowledge("liver", at(ms)); }
  bool acknowledgedAt(int ms) const { return warningOf(monitor_, at(ms)).acknowledged; }
  // Warned of again from then on, it is not acknowledged any more.
  void expectEndedFrom(int begin_ms) {
    for (int ms = begin_ms; ms < 2000; ms += 10) warnAt(ms);
    EXPECT_EQ(levelAt(1990), WarningLevel::kConsidered);
    EXPECT_FALSE(acknowledgedAt(1990));
  }
};

TEST_F(AcknowledgedTest, IsNoPermission) {
  const Warning before = warningOf(monitor_, at(1000));
  ASSERT_EQ(acknowledge(1000), "");
  const Warning after = warningOf(monitor_, at(1000));
  EXPECT_TRUE(after.acknowledged);
  EXPECT_EQ(after.level, WarningLevel::kConsidered);
  EXPECT_EQ(after.reasons, before.reasons);
  EXPECT_EQ(after.mesh_id, before.mesh_id);
  EXPECT_EQ(after.time_to_collision, before.time_to_collision);
  EXPECT_EQ(after.text, before.text + "; acknowledged");
}

TEST_F(AcknowledgedTest, EndsWithItsTime) {
  ASSERT_EQ(acknowledge(1000), "");
  for (int ms = 1010; ms <= 12000; ms += 10) {
    warnAt(ms);
    ASSERT_EQ(acknowledgedAt(ms), ms <= 11000) << ms;
    ASSERT_EQ(levelAt(ms), WarningLevel::kConsidered) << ms;
  }
  EXPECT_TRUE(monitor_.acknowledged(at(12000).steady).empty());
}

// The tool comes and goes beside the same surface.
TEST_F(AcknowledgedTest, OutlastsAPauseOfTheWarning) {
  ASSERT_EQ(acknowledge(1000), "");
  for (int ms = 1010; ms < 2000; ms += 10) predict(predictionFrom(refresh(ms), ms), ms);
  EXPECT_EQ(levelAt(1990), WarningLevel::kClear);
  EXPECT_FALSE(acknowledgedAt(1990));
  warnAt(2000);
  EXPECT_TRUE(acknowledgedAt(2000));
}

TEST_F(AcknowledgedTest, EndsAtReflex) {
  ASSERT_EQ(acknowledge(1000), "");
  warnAt(1010, 100);
  EXPECT_EQ(levelAt(1010), WarningLevel::kReflex);
  EXPECT_FALSE(acknowledgedAt(1010));
  expectEndedFrom(1020);
}

// No prediction says so: the warning rose with the clock.
TEST_F(AcknowledgedTest, EndsAtAReflexThatCameWithTime) {
  ASSERT_EQ(acknowledge(1000), "");
  EXPECT_EQ(levelAt(1400), WarningLevel::kReflex);
  EXPECT_FALSE(acknowledgedAt(1400));
  expectEndedFrom(1400);
}

TEST_F(AcknowledgedTest, EndsAtContact) {
  ASSERT_EQ(acknowledge(1000), "");
  sweep(reportOf(workpieces_, {3}), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kContact);
  EXPECT_FALSE(acknowledgedAt(1010));
  expectEndedFrom(1020);
}

TEST_F(AcknowledgedTest, EndsWhenTheToolHasLeftAndWithARestart) {
  ASSERT_EQ(acknowledge(1000), "");
  EXPECT_EQ(monitor_.acknowledged(at(1000).steady), std::vector<std::string>{"liver"});
  monitor_.endAcknowledgement("spleen");
  EXPECT_TRUE(acknowledgedAt(1000));
  monitor_.endAcknowledgement("liver");
  EXPECT_FALSE(acknowledgedAt(1000));
  EXPECT_EQ(levelAt(1000), WarningLevel::kConsidered);
  ASSERT_EQ(acknowledge(1000), "");
  monitor_.restart();
  warnAt(1010);
  EXPECT_FALSE(acknowledgedAt(1010));
}

TEST_F(AcknowledgedTest, EndsWhenTheMeshIsReplacedOrRemoved) {
  ASSERT_EQ(acknowledge(1000), "");
  monitor_.setWorkpieces({workpiece("liver", 1000, /*revision=*/2)});
  EXPECT_EQ(levelAt(1000), WarningLevel::kConsidered);
  EXPECT_FALSE(acknowledgedAt(1000));
  warnAt(1010);
  ASSERT_EQ(acknowledge(1010), "");
  monitor_.setWorkpieces({});
  warnAt(1020);
  EXPECT_FALSE(acknowledgedAt(1020));
}

TEST_F(AcknowledgedTest, AnotherWorkpieceIsWarnedOfAsEver) {
  ASSERT_EQ(acknowledge(1000), "");
  const Workpieces two = {workpiece("liver", 1010), workpiece("spleen", 1010)};
  monitor_.setWorkpieces(two);
  sweepOnly(reportOf(two), 1010);
  Prediction both = collisionOn(two, 1010, 300);
  both.objects[1].sweeps[1] = {milliseconds(800), /*contact=*/true, kMeeting};
  predict(both, 1010);
  const Warning warning = warningOf(monitor_, at(1010));
  EXPECT_EQ(warning.mesh_id, "spleen");  // it comes later, and the operator does not know of it
  EXPECT_FALSE(warning.acknowledged);
  ASSERT_EQ(monitor_.acknowledge("spleen", at(1010)), "");
  EXPECT_EQ(warningOf(monitor_, at(1010)).mesh_id, "liver");
  EXPECT_TRUE(acknowledgedAt(1010));
}

TEST_F(AcknowledgedTest, IsOnlyWhatIsWarnedOfAndNoMoreThanConsidered) {
  EXPECT_TRUE(has(monitor_.acknowledge("spleen", at(1000)), "no warning of 'spleen'"));
  warnAt(1010, 100);
  EXPECT_TRUE(has(acknowledge(1010), "not REFLEX"));
  sweep(reportOf(workpieces_, {3}), 1020);
  EXPECT_TRUE(has(acknowledge(1020), "not CONTACT"));
  monitor_.restart();
  EXPECT_TRUE(has(acknowledge(1020), "not UNKNOWN"));
  predict(predictionFrom(refresh(1030), 1030), 1030);
  EXPECT_TRUE(has(acknowledge(1030), "not CLEAR"));
}

}  // namespace
}  // namespace sweep_guard_core
