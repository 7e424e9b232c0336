#include "sweep_guard/monitor/warning_monitor.h"
#include "monitor/warnings.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "guard/cross_check.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

constexpr WarningThresholds kThresholds;
constexpr WarningLimits kLimits = {milliseconds(100), milliseconds(500), milliseconds(500)};

Instant at(int ms) { return {Time(milliseconds(ms)), SteadyTime(milliseconds(ms))}; }
Timestamps timestampsAt(int ms) { return {at(ms).stamp, at(ms).steady}; }

std::shared_ptr<const Workpiece> workpiece(const std::string& id, int ms, std::uint32_t revision = 1) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  return std::make_shared<const Workpiece>(Workpiece{id, revision, at(ms).stamp, at(ms).steady, "table", mesh});
}

SweepReport reportOf(const Workpieces& workpieces, const std::vector<std::uint32_t>& in_contact = {}) {
  SweepReport report;
  report.end = at(1000).stamp;
  for (const auto& one : workpieces) report.objects.push_back({one, {}, {}, {in_contact, 0.0, {}, false, in_contact}});
  return report;
}

// From a pose on, 1.1 s ahead in two sweeps.
Prediction predictionFrom(const Workpieces& workpieces, int ms) {
  Prediction prediction;
  prediction.stamp = at(ms).stamp;
  prediction.path.resize(2);
  prediction.path[0].ahead = milliseconds(100);
  prediction.path[1].ahead = milliseconds(1100);
  for (const auto& one : workpieces)
    prediction.objects.push_back({one, {{milliseconds(0)}, {milliseconds(100)}}, {}, {}, {}});
  return prediction;
}

// One that meets its first workpiece after so long.
Prediction collisionOn(const Workpieces& workpieces, int ms, int after_ms) {
  Prediction prediction = predictionFrom(workpieces, ms);
  prediction.objects[0].sweeps[1] = {milliseconds(after_ms), /*contact=*/true, /*probability=*/0.75};
  prediction.objects[0].considered = {4};
  return prediction;
}

// One that only may meet its first workpiece after so long.
Prediction probableOn(const Workpieces& workpieces, int ms, int after_ms, double probability) {
  Prediction prediction = predictionFrom(workpieces, ms);
  prediction.objects[0].sweeps[1] = {milliseconds(after_ms), /*contact=*/false, probability};
  return prediction;
}

class WarningMonitorTest : public testing::Test {
 protected:
  // A fresh workpiece, swept at a fresh pose and looked ahead from there.
  WarningMonitorTest() {
    monitor_.setWorkpieces(workpieces_);
    sweep(reportOf(workpieces_), 1000);
  }

  void sweep(const SweepReport& report, int ms) {
    sweepOnly(report, ms);
    Workpieces tested;
    for (const SweptObject& object : report.objects) tested.push_back(object.workpiece);
    predict(predictionFrom(tested, ms), ms);
  }
  void sweepOnly(SweepReport report, int ms) {
    report.end = at(ms).stamp;
    monitor_.swept(report, timestampsAt(ms), monitor_.checkpoint(), at(ms).steady);
  }
  // The workpiece comes again, and is swept.
  Workpieces refresh(int ms) {
    Workpieces fresh = {workpiece("liver", ms)};
    monitor_.setWorkpieces(fresh);
    sweepOnly(reportOf(fresh), ms);
    return fresh;
  }
  void predict(const Prediction& prediction, int pose_ms) {
    monitor_.predicted(prediction, timestampsAt(pose_ms), monitor_.checkpoint(), at(pose_ms));
  }

  void disagree(const SampledQuery& query, const std::vector<std::uint32_t>& missed) {
    monitor_.detectorsDisagree("detectors disagree", query, missed, at(1000).steady);
  }
  SampledQuery query(bool measured = true) const {
    SampledQuery query;
    query.workpiece = workpieces_[0];
    query.origin = {measured, monitor_.checkpoint().epoch};
    return query;
  }

  WarningLevel levelAt(int ms) const { return warningOf(monitor_, at(ms)).level; }
  std::uint32_t reasonsAt(int ms) const { return warningOf(monitor_, at(ms)).reasons; }

  const Workpieces workpieces_ = {workpiece("liver", 1000)};
  WarningMonitor monitor_{kLimits};
};

TEST_F(WarningMonitorTest, AnOverloadIsReportedAndHeldButDoesNotChangeTheLevel) {
  SweepReport report = reportOf(workpieces_);
  report.backlog = milliseconds(20);
  sweep(report, 1010);
  EXPECT_EQ(reasonsAt(1010), 0U);
  report.backlog = milliseconds(21);
  sweep(report, 1020);
  sweep(reportOf(workpieces_), 1030);
  EXPECT_EQ(reasonsAt(1030), kOverload);
  EXPECT_EQ(levelAt(1030), WarningLevel::kClear);
  sweep(reportOf(workpieces_), 1480);
  EXPECT_EQ(reasonsAt(1480), kOverload);
  monitor_.setWorkpieces({workpiece("liver", 1500)});
  sweep(reportOf({workpiece("liver", 1500)}), 1521);
  EXPECT_EQ(reasonsAt(1521) & kOverload, 0U);
}

TEST_F(WarningMonitorTest, AnOverloadIsForgottenWhenTimeJumps) {
  SweepReport report = reportOf(workpieces_);
  report.backlog = milliseconds(50);
  sweep(report, 1010);
  monitor_.timeJumped("time went back");
  EXPECT_EQ(reasonsAt(1010) & kOverload, 0U);
}

TEST(EmptyWarningMonitorTest, KnowsNothing) {
  const Warning warning = warningOf(WarningMonitor(kLimits), at(0));
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_EQ(warning.reasons, kNoPose | kNoMesh);
  EXPECT_EQ(warning.covered_until, Time());
}

TEST_F(WarningMonitorTest, IsClearUntilTheInputsAgeOut) {
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
  EXPECT_EQ(warningOf(monitor_, at(1000)).covered_until, at(2100).stamp);
  EXPECT_EQ(levelAt(1100), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1101), kPoseStale);
  EXPECT_EQ(reasonsAt(1501), kPoseStale | kMeshStale);
}

TEST_F(WarningMonitorTest, AFaultLastsUntilALaterPoseIsSwept) {
  monitor_.fault(kPoseInvalid, "NaN");
  EXPECT_EQ(reasonsAt(1000), kPoseInvalid);
  EXPECT_TRUE(has(warningOf(monitor_, at(1000)).text, "NaN"));
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

// A pose that came before the bad one cannot vouch for what came after it.
TEST_F(WarningMonitorTest, AFaultIsNotClearedByAnEarlierPose) {
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  monitor_.fault(kPoseInvalid, "NaN");
  monitor_.swept(reportOf(workpieces_), timestampsAt(1010), before, at(1010).steady);
  EXPECT_EQ(reasonsAt(1010), kPoseInvalid);
}

TEST_F(WarningMonitorTest, AFailureLastsUntilALaterPoseIsSwept) {
  monitor_.failed(kDetectorFault, "thread 'guard' failed: no memory", at(900).steady);
  const Warning failed = warningOf(monitor_, at(1000));
  EXPECT_EQ(failed.level, WarningLevel::kUnknown);
  EXPECT_EQ(failed.reasons, kDetectorFault);
  EXPECT_TRUE(has(failed.text, "thread 'guard' failed: no memory"));
  sweep(reportOf(workpieces_), 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).level, WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, AFailureIsNotClearedByAnEarlierPose) {
  const auto before = monitor_.checkpoint();
  monitor_.failed(kDetectorFault, "no memory", at(900).steady);
  monitor_.swept(reportOf(workpieces_), timestampsAt(1000), before, at(1000).steady);
  EXPECT_EQ(warningOf(monitor_, at(1000)).level, WarningLevel::kUnknown);
}

// The next sweep may come before anybody has seen it.
TEST_F(WarningMonitorTest, AFailureIsShownForATenthOfASecondAtLeast) {
  monitor_.failed(kDetectorFault, "no memory", at(900).steady);
  sweep(reportOf(workpieces_), 999);
  EXPECT_EQ(warningOf(monitor_, at(999)).reasons, kDetectorFault);
  sweep(reportOf(workpieces_), 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).level, WarningLevel::kClear);
}

// What is lost is not sent again.
TEST_F(WarningMonitorTest, ALastingFailureEndsWithARestartOnly) {
  monitor_.failed(kDetectorFault, "a mesh is lost", at(900).steady, /*lasting=*/true);
  monitor_.failed(kDetectorFault, "no memory", at(900).steady);
  sweep(reportOf(workpieces_), 1000);
  monitor_.timeJumped("time went back");
  sweep(reportOf(workpieces_), 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).reasons, kDetectorFault);
  EXPECT_FALSE(monitor_.meshProblems(at(1000), {}).empty());
  monitor_.restart();
  sweep(reportOf(workpieces_), 1000);
  EXPECT_EQ(warningOf(monitor_, at(1000)).level, WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, ALongMessageOfAFailureIsCut) {
  monitor_.failed(kDetectorFault, std::string(1000, 'x').c_str(), at(900).steady);
  EXPECT_LT(warningOf(monitor_, at(1000)).text.size(), 200U);
}

TEST(HungThreadTest, IsUnknownForAsLongAsItHangs) {
  const char* hung = nullptr;
  WarningMonitor monitor(
      kLimits, [] {}, [] { return std::nullopt; }, [&] { return hung; });
  hung = "guard";
  EXPECT_EQ(warningOf(monitor, at(0)).level, WarningLevel::kUnknown);
  EXPECT_TRUE(warningOf(monitor, at(0)).reasons & kWorkerHung);
  EXPECT_TRUE(has(warningOf(monitor, at(0)).text, "thread 'guard' makes no progress"));
  hung = nullptr;
  EXPECT_FALSE(warningOf(monitor, at(0)).reasons & kWorkerHung);
}

TEST(WarningMonitorFaultTest, EveryFaultIsReportedAtOnce) {
  int reports = 0;
  WarningMonitor monitor(kLimits, [&] { ++reports; });
  monitor.fault(kPoseInvalid, "NaN");
  EXPECT_EQ(reports, 1);
  monitor.meshRefused("liver", "NaN", at(1000).steady);
  monitor.verticesRefused("liver", "NaN", at(1000).steady);
  EXPECT_EQ(reports, 3);
  SweepReport failed;
  failed.failures.push_back({workpiece("liver", 1000), "no canary"});
  monitor.swept(failed, timestampsAt(1000), monitor.checkpoint(), at(1000).steady);
  EXPECT_EQ(reports, 4);
  Prediction prediction;
  prediction.failures = failed.failures;
  monitor.predicted(prediction, timestampsAt(1000), monitor.checkpoint(), at(1000));
  EXPECT_EQ(reports, 5);
  EXPECT_NE(warningOf(monitor, at(1000)).reasons & kDetectorFault, 0U);
}

TEST_F(WarningMonitorTest, ARefusedMeshCountsUntilItsNextGoodOne) {
  monitor_.meshRefused("liver", "NaN vertex", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  monitor_.meshAccepted("spleen", at(1000).steady);
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1050), WarningLevel::kClear);
}

// What the refused mesh announced is still unknown, however good the vertices of the one before are.
TEST_F(WarningMonitorTest, ARefusedMeshIsNotClearedByVertices) {
  monitor_.meshRefused("liver", "too large", at(1000).steady);
  monitor_.verticesRefused("liver", "wrong revision", at(1000).steady);
  monitor_.verticesAccepted("liver", at(1000).steady);
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  EXPECT_TRUE(has(warningOf(monitor_, at(1050)).text, "too large"));
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1050), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, RefusedVerticesAreClearedByGoodVerticesAndByAMesh) {
  monitor_.verticesRefused("liver", "NaN vertex", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  monitor_.verticesAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
  monitor_.verticesRefused("liver", "NaN vertex", at(1000).steady);
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
}

// Nobody knows where it is: as long as it is neither sent well nor removed, nothing is clear.
TEST_F(WarningMonitorTest, ARefusedMeshOfAnUnknownWorkpieceIsNotForgotten) {
  monitor_.meshRefused("ghost", "NaN vertex", at(1000).steady);
  EXPECT_NE(reasonsAt(1000000) & kMeshInvalid, 0U);
}

TEST_F(WarningMonitorTest, AFloodOfRefusedMeshesIsNotClearWhenSomeAreAccepted) {
  for (int i = 0; i < 1000; ++i) monitor_.meshRefused("ghost" + std::to_string(i), "no mesh", at(1000).steady);
  for (int i = 0; i < 50; ++i) monitor_.meshAccepted("ghost" + std::to_string(i), at(1000).steady);
  EXPECT_NE(reasonsAt(1000) & kMeshInvalid, 0U);
}

TEST_F(WarningMonitorTest, CoverageEndsWhereAWorkpieceCouldNotBeSwept) {
  SweepReport report = reportOf(workpieces_);
  report.end = at(1010).stamp;
  report.failures.push_back({workpiece("spleen", 1000), "no canary"});
  sweep(report, 1010);
  EXPECT_EQ(warningOf(monitor_, at(1010)).covered_until, at(1000).stamp);  // what lies before the prediction is a hole
  EXPECT_EQ(warningOf(monitor_, at(1010)).pose_stamp, at(1010).stamp);
}

TEST_F(WarningMonitorTest, ANewWorkpieceOrRevisionIsNotClearBeforeItIsSwept) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  EXPECT_EQ(reasonsAt(1000), kNotSwept | kNotCovered);
  sweep(reportOf(two), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
  monitor_.setWorkpieces({workpieces_[0], workpiece("spleen", 1010, /*revision=*/2)});
  EXPECT_EQ(reasonsAt(1010), kNotSwept | kNotCovered);
}

TEST_F(WarningMonitorTest, AContactIsHeldWhileLaterSweepsAreFree) {
  sweep(reportOf(workpieces_, {3, 5}), 1010);
  EXPECT_EQ(levelAt(1000000), WarningLevel::kContact);  // as far as is known it lasts
  sweep(reportOf(workpieces_), 1020);
  const Warning held = warningOf(monitor_, at(1510));
  EXPECT_EQ(held.level, WarningLevel::kContact);
  EXPECT_EQ(held.mesh_id, "liver");
  EXPECT_EQ(held.triangles, (std::vector<std::uint32_t>{3, 5}));
  EXPECT_NE(levelAt(1511), WarningLevel::kContact);
}

TEST_F(WarningMonitorTest, AContactLastsWhileItsWorkpieceCannotBeSwept) {
  sweep(reportOf(workpieces_, {3}), 1010);
  SweepReport failed;
  failed.failures.push_back({workpieces_[0], "no canary"});
  sweep(failed, 1020);
  EXPECT_EQ(levelAt(5000), WarningLevel::kContact);
  monitor_.setWorkpieces({});
  sweep({}, 1030);  // it has been removed
  EXPECT_EQ(levelAt(5000), WarningLevel::kUnknown);
}

TEST_F(WarningMonitorTest, ATimeJumpClearsPoseAndFaults) {
  monitor_.fault(kTfFail, "no transform");
  monitor_.timeJumped("time went back");
  const Warning warning = warningOf(monitor_, at(1010));
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_EQ(warning.reasons, kTimeJump | kNoPose);
  EXPECT_EQ(warning.covered_until, Time());
}

TEST_F(WarningMonitorTest, APoseFromBeforeAJumpOfTimeVouchesForNothing) {
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  monitor_.timeJumped("time went back");
  monitor_.swept(reportOf(workpieces_), timestampsAt(1010), before, at(1010).steady);
  monitor_.predicted(collisionOn(workpieces_, 1010, 0), timestampsAt(1010), before, at(1010));
  EXPECT_EQ(levelAt(1010), WarningLevel::kUnknown);
  EXPECT_EQ(reasonsAt(1010), kTimeJump | kNoPose);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

// Poses may come faster than predictions: one serves until the pose that it began at is stale.
TEST_F(WarningMonitorTest, APredictionVouchesForLaterPosesUntilItsOwnIsStale) {
  for (int ms = 1001; ms <= 1100; ++ms) {
    sweepOnly(reportOf(workpieces_), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kClear) << ms;
  }
  sweepOnly(reportOf(workpieces_), 1101);
  EXPECT_EQ(reasonsAt(1101), kNotCovered);
  EXPECT_EQ(warningOf(monitor_, at(1101)).covered_until, at(1101).stamp);
  predict(predictionFrom(workpieces_, 1101), 1101);
  EXPECT_EQ(levelAt(1101), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, APredictionThatBeginsBeyondWhatWasSweptLeavesAHole) {
  predict(predictionFrom(workpieces_, 1001), 1001);
  EXPECT_EQ(reasonsAt(1001), kNotCovered);
  sweepOnly(reportOf(workpieces_), 1001);
  EXPECT_EQ(levelAt(1001), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, APredictionThatDoesNotReachTheEndOfTheConsideredIntervalIsNotClear) {
  Prediction prediction = predictionFrom(workpieces_, 1000);
  prediction.path.pop_back();
  predict(prediction, 1000);
  EXPECT_EQ(reasonsAt(1000), kNotCovered);
  EXPECT_EQ(warningOf(monitor_, at(1000)).covered_until, at(1100).stamp);
  prediction.path.clear();
  predict(prediction, 1000);
  EXPECT_EQ(reasonsAt(1000), kNotCovered);
}

TEST_F(WarningMonitorTest, APredictionThatLeftOutAWorkpieceIsNotClear) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  sweepOnly(reportOf(two), 1010);
  predict(predictionFrom(workpieces_, 1010), 1010);
  EXPECT_EQ(reasonsAt(1010), kNotCovered);
  Prediction unplaced = predictionFrom(workpieces_, 1010);
  unplaced.unplaced = {two[1]};
  predict(unplaced, 1010);
  EXPECT_EQ(reasonsAt(1010), kNotCovered);
  predict(predictionFrom(two, 1010), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, AFailedPredictionIsAFaultUntilALaterPose) {
  Prediction failed = predictionFrom({}, 1000);
  failed.failures.push_back({workpieces_[0], "no canary"});
  predict(failed, 1000);
  EXPECT_EQ(reasonsAt(1000), kDetectorFault | kNotCovered);
  EXPECT_TRUE(has(warningOf(monitor_, at(1000)).text, "no canary"));
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

// No prediction comes between, only time.
TEST_F(WarningMonitorTest, AWarningRisesByItself) {
  predict(collisionOn(workpieces_, 1000, 1050), 1000);
  EXPECT_EQ(levelAt(1034), WarningLevel::kClear);
  EXPECT_EQ(levelAt(1035), WarningLevel::kConsidered);
  EXPECT_EQ(levelAt(1934), WarningLevel::kConsidered);
  EXPECT_EQ(levelAt(1935), WarningLevel::kReflex);
  const Warning warning = warningOf(monitor_, at(1100));
  EXPECT_EQ(warning.time_to_collision, milliseconds(950));
  EXPECT_EQ(warning.probability, 0.75);
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
  for (const auto& [after_ms, threshold, level] :
       {std::tuple(100, kThresholds.reflex, WarningLevel::kReflex),
        std::tuple(500, kThresholds.considered_on, WarningLevel::kConsidered)}) {
    monitor_.restart();
    sweepOnly(reportOf(workpieces_), 1000);
    predict(probableOn(workpieces_, 1000, after_ms, threshold - 1e-9), 1000);
    EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
    predict(probableOn(workpieces_, 1000, after_ms, threshold), 1000);
    EXPECT_EQ(levelAt(1000), level);
  }
}

TEST_F(WarningMonitorTest, AConsideredWarningStaysDownToALowerProbability) {
  for (int ms = 1000; ms < 3000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, ms == 1000 ? kThresholds.considered_on : kThresholds.considered_off), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kConsidered) << ms;
  }
  for (int ms = 3000; ms < 4000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kThresholds.considered_off - 1e-9), ms);
    ASSERT_EQ(levelAt(ms), ms <= 3500 ? WarningLevel::kConsidered : WarningLevel::kClear) << ms;
  }
  predict(probableOn(refresh(3990), 3990, 500, kThresholds.considered_on - 1e-9), 3990);
  EXPECT_EQ(levelAt(3990), WarningLevel::kClear);
}

// The path meets it first; what is left is doubt.
TEST_F(WarningMonitorTest, AWarningThatThePathRaisedStaysDownToALowerProbability) {
  predict(collisionOn(workpieces_, 1000, 500), 1000);
  for (int ms = 1010; ms < 2000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kThresholds.considered_off), ms);
    ASSERT_EQ(levelAt(ms), WarningLevel::kConsidered) << ms;
  }
}

TEST_F(WarningMonitorTest, WhatKeepsAWarningUpRaisesNoneOfAnotherWorkpiece) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  predict(probableOn(two, 1000, 500, kThresholds.considered_on), 1000);
  const double between = 0.5 * (kThresholds.considered_on + kThresholds.considered_off);
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
  predict(probableOn(workpieces_, 1000, 500, kThresholds.considered_on), 1000);
  predict(probableOn(workpieces_, 1010, 1050, kThresholds.considered_off), 1010);
  EXPECT_EQ(levelAt(1510), WarningLevel::kConsidered);
  EXPECT_NE(levelAt(1511), WarningLevel::kConsidered);
}

TEST_F(WarningMonitorTest, AWarningThatEndedWithItsPredictionIsNotKeptUpByLess) {
  predict(probableOn(workpieces_, 1000, 500, kThresholds.considered_on), 1000);
  predict(probableOn(refresh(5000), 5000, 500, kThresholds.considered_off), 5000);
  EXPECT_EQ(levelAt(5000), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, AnUrgentContactThatIsUnlikelyIsNoReflex) {
  predict(probableOn(workpieces_, 1000, 500, kThresholds.considered_on), 1000);
  predict(probableOn(workpieces_, 1010, 100, kThresholds.reflex - 1e-9), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kConsidered);
}

// Both are predicted to be met; the urgent one is named, and each has a time of its own.
TEST_F(WarningMonitorTest, OfTwoPredictedContactsTheUrgentOneIsNamedUntilItIsOver) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  Prediction prediction = collisionOn(two, 1000, 500);
  prediction.objects[1].sweeps[1] = {milliseconds(300), /*contact=*/true, /*probability=*/0.75};
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
  predict(probableOn(workpieces_, 1000, 500, kThresholds.considered_on), 1000);
  monitor_.setWorkpieces({});
  predict(predictionFrom({}, 1010), 1010);
  for (int ms = 1020; ms < 2000; ms += 10) {
    predict(probableOn(refresh(ms), ms, 500, kThresholds.considered_off), ms);
    ASSERT_EQ(levelAt(ms), ms <= 1510 ? WarningLevel::kConsidered : WarningLevel::kClear) << ms;
  }
}

TEST_F(WarningMonitorTest, AContactIsHeldFromWhenTheToolWasLastFoundToTouch) {
  sweep(reportOf(workpieces_, {3}), 1010);
  EXPECT_FALSE(warningOf(monitor_, at(1300)).held_since);
  sweep(reportOf(workpieces_), 1020);
  const Warning held = warningOf(monitor_, at(1310));
  EXPECT_EQ(held.level, WarningLevel::kContact);
  EXPECT_EQ(held.held_since, at(1010).stamp);
  EXPECT_TRUE(has(held.text, "CONTACT: tool touched 'liver' 0.30 s ago, 1 triangle"));
  sweep(reportOf(workpieces_, {3}), 1320);
  EXPECT_FALSE(warningOf(monitor_, at(1320)).held_since);
  EXPECT_TRUE(has(warningOf(monitor_, at(1320)).text, "CONTACT: tool meets 'liver', 1 triangle"));
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
  both.objects[1].sweeps[1] = {milliseconds(800), /*contact=*/true, /*probability=*/0.75};
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

TEST_F(WarningMonitorTest, ATimeJumpClearsPredictedContactsAndWarnings) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  predict(collisionOn(workpieces_, 1010, 500), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kReflex);
  monitor_.timeJumped("time went back");
  const Warning warning = warningOf(monitor_, at(1010));
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_FALSE(warning.time_to_collision);
  sweepOnly(reportOf(workpieces_), 1020);
  EXPECT_EQ(reasonsAt(1020), kNotCovered);
}

TEST_F(WarningMonitorTest, DisabledIsUnknownByWhomItWasAskedWhateverCame) {
  sweep(reportOf(workpieces_, {3}), 1010);
  monitor_.disable("/somebody");
  monitor_.disable("/somebody_else");
  monitor_.fault(kTfFail, "no transform");
  const Warning warning = warningOf(monitor_, at(1010));
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_EQ(warning.reasons, kDisabled);
  EXPECT_EQ(warning.text, "UNKNOWN: disabled by /somebody: nothing is tested");
  EXPECT_EQ(warning.covered_until, Time());
}

TEST_F(WarningMonitorTest, AnEndingGuardIsUnknownWhateverItMetAndWhateverComes) {
  sweep(reportOf(workpieces_, {3}), 1010);
  monitor_.disable("/somebody");
  monitor_.end();
  monitor_.enable();
  EXPECT_FALSE(monitor_.counts(monitor_.checkpoint()));
  sweep(reportOf(workpieces_), 1020);
  const Warning warning = warningOf(monitor_, at(1020));
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_EQ(warning.reasons, kDisabled);
  EXPECT_EQ(warning.text, "UNKNOWN: the guard is shutting down");
}

TEST_F(WarningMonitorTest, WhatCameBeforeOrWhileItWasDisabledDoesNotCount) {
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  EXPECT_TRUE(monitor_.counts(before));
  monitor_.disable("/somebody");
  const WarningMonitor::Checkpoint meanwhile = monitor_.checkpoint();
  EXPECT_FALSE(monitor_.counts(before));
  EXPECT_FALSE(monitor_.counts(meanwhile));
  monitor_.enable();
  EXPECT_FALSE(monitor_.counts(before));
  EXPECT_FALSE(monitor_.counts(meanwhile));
  EXPECT_TRUE(monitor_.counts(monitor_.checkpoint()));
  monitor_.swept(reportOf(workpieces_), timestampsAt(1010), meanwhile, at(1010).steady);
  EXPECT_EQ(reasonsAt(1010), kNoPose);
  sweep(reportOf(workpieces_), 1020);
  EXPECT_EQ(levelAt(1020), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, ToEnableWhatIsEnabledForgetsNothing) {
  monitor_.enable();
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, RestartEndsWhatIsHeldButNotARefusedMesh) {
  sweep(reportOf(workpieces_, {3}), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kContact);
  monitor_.restart();
  EXPECT_EQ(reasonsAt(1010), kNoPose);
  monitor_.meshRefused("liver", "workpiece 'liver' refused", at(1000).steady);
  monitor_.restart();
  EXPECT_EQ(reasonsAt(1010), kNoPose | kMeshInvalid);
}

// Nothing else would end it: there is no workpiece to send well or to remove.
TEST_F(WarningMonitorTest, AMessageOfNoWorkpieceCountsForASecond) {
  for (const Duration mesh_timeout : {Duration(milliseconds(5000)), Duration::max()}) {
    WarningLimits limits = kLimits;
    limits.mesh_timeout = mesh_timeout;
    monitor_.setLimits(limits);
    monitor_.meshUnread("vertices of 'ghost' came before their mesh", at(1000).steady);
    monitor_.meshUnread("vertices of 'ghost' came again", at(1200).steady);
    sweep(reportOf(workpieces_), 2150);
    EXPECT_EQ(reasonsAt(2200), kMeshInvalid);
    EXPECT_TRUE(has(warningOf(monitor_, at(2200)).text, "came again"));
    EXPECT_EQ(levelAt(2201), WarningLevel::kClear);
  }
}

TEST(EventsTest, AreReportedAtOnce) {
  int reported = 0;
  WarningMonitor monitor(kLimits, [&] { ++reported; });
  monitor.meshUnread("id is empty", at(1000).steady);
  EXPECT_EQ(reported, 1);
  monitor.posesLost("1 tool pose was lost", at(1000).steady);
  EXPECT_EQ(reported, 2);
  monitor.updateDropped("liver", at(1000).steady);
  EXPECT_EQ(reported, 2);  // there is none
  monitor.setWorkpieces({workpiece("liver", 1000)});
  monitor.updateDropped("liver", at(1000).steady);
  EXPECT_EQ(reported, 3);
}

TEST_F(WarningMonitorTest, NeedsEveryRequiredWorkpiece) {
  monitor_.require({"liver", "spleen"});
  EXPECT_EQ(reasonsAt(1000), kNoMesh);
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  sweep(reportOf(two), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
  monitor_.setWorkpieces(workpieces_);
  EXPECT_EQ(reasonsAt(1010), kNoMesh);
  monitor_.restart();
  EXPECT_EQ(reasonsAt(1010), kNoMesh | kNoPose);
  monitor_.require({});
  EXPECT_EQ(reasonsAt(1010), kNoPose);
}

TEST_F(WarningMonitorTest, ADroppedUpdateCountsUntilALaterOneIsSwept) {
  monitor_.updateDropped("liver", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshDropped);
  EXPECT_TRUE(has(warningOf(monitor_, at(1000)).text, "vertices of workpiece 'liver' were dropped"));
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(reasonsAt(1010), kMeshDropped);
  Workpiece updated = *workpieces_[0];
  updated.received = at(1015).steady;
  const Workpieces later = {std::make_shared<const Workpiece>(updated)};
  monitor_.setWorkpieces(later);
  EXPECT_EQ(reasonsAt(1015), kMeshDropped);
  sweep(reportOf(later), 1020);
  EXPECT_EQ(levelAt(1020), WarningLevel::kClear);
}

// A new mesh begins to count its updates at 0.
TEST_F(WarningMonitorTest, ADroppedUpdateEndsWithANewMeshOfThatWorkpiece) {
  Workpiece much_updated = *workpieces_[0];
  much_updated.updates = 10000;
  monitor_.setWorkpieces({std::make_shared<const Workpiece>(much_updated)});
  monitor_.updateDropped("liver", at(1000).steady);
  const Workpieces remeshed = {workpiece("liver", 1010, /*revision=*/2)};
  monitor_.setWorkpieces(remeshed);
  sweep(reportOf(remeshed), 1020);
  EXPECT_EQ(levelAt(1020), WarningLevel::kClear);
}

// A mesh is converted after it was received, and refused sooner than the mesh before it is accepted.
TEST_F(WarningMonitorTest, ARefusalOutlastsMessagesThatWereReceivedBefore) {
  monitor_.meshRefused("liver", "NaN vertex", at(1002).steady);
  monitor_.verticesRefused("liver", "wrong revision", at(1002).steady);
  monitor_.meshAccepted("liver", at(1001).steady);
  monitor_.verticesAccepted("liver", at(1003).steady);
  EXPECT_EQ(reasonsAt(1003), kMeshInvalid);
  EXPECT_FALSE(monitor_.meshProblems(at(1003), {"liver"}).empty());
  monitor_.meshAccepted("liver", at(1003).steady);
  EXPECT_EQ(reasonsAt(1003), 0U);
}

TEST_F(WarningMonitorTest, ADroppedUpdateIsForgottenWithItsWorkpiece) {
  monitor_.updateDropped("liver", at(1000).steady);
  monitor_.updateDropped("ghost", at(1000).steady);
  monitor_.setWorkpieces({});
  EXPECT_EQ(reasonsAt(1000) & kMeshDropped, 0U);
  monitor_.setWorkpieces(workpieces_);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, LostPosesAreReportedAndHeldButLeaveTheLevel) {
  monitor_.posesLost("2 tool poses were lost on the way", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kPoseLoss);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
  sweep(reportOf(workpieces_), 1480);
  EXPECT_EQ(reasonsAt(1500), kPoseLoss);
  EXPECT_EQ(reasonsAt(1501) & kPoseLoss, 0U);
  monitor_.posesLost("2 tool poses were lost on the way", at(1480).steady);
  monitor_.timeJumped("time went back");
  EXPECT_EQ(reasonsAt(1480) & kPoseLoss, 0U);
}

TEST(WaitingPosesTest, KeepTheWarningFromClearOnceTheyWaitLongerThanALookAhead) {
  std::optional<SteadyTime> waiting_since;
  WarningMonitor monitor(
      kLimits, [] {}, [&] { return waiting_since; });
  const Workpieces workpieces = {workpiece("liver", 1000)};
  monitor.setWorkpieces(workpieces);
  SweepReport report = reportOf(workpieces);
  monitor.swept(report, timestampsAt(1000), monitor.checkpoint(), at(1000).steady);
  const auto predict = [&](Duration took) {
    monitor.predicted(predictionFrom(workpieces, 1000), timestampsAt(1000), monitor.checkpoint(), at(1000), took);
  };
  const auto reasonsAt = [&](int ms) { return warningOf(monitor, at(ms)).reasons; };
  predict(milliseconds(5));
  EXPECT_EQ(reasonsAt(1050), 0U);
  waiting_since = at(1001).steady;
  EXPECT_EQ(reasonsAt(1021), 0U);
  EXPECT_EQ(reasonsAt(1022), kPosesUnswept);
  predict(milliseconds(66));
  EXPECT_EQ(reasonsAt(1067), 0U);
  EXPECT_EQ(reasonsAt(1068), kPosesUnswept);
  waiting_since.reset();
  EXPECT_EQ(reasonsAt(1068), 0U);
}

TEST_F(WarningMonitorTest, ASweepFarBehindAMeshDoesNotCount) {
  SweepReport report = reportOf(workpieces_);
  report.objects[0].behind = milliseconds(30);
  sweep(report, 1010);
  EXPECT_EQ(reasonsAt(1010), kNotSwept | kNotCovered);
  EXPECT_TRUE(has(warningOf(monitor_, at(1010)).text, "tool poses are 0.03 s behind workpiece 'liver'"));
  EXPECT_EQ(warningOf(monitor_, at(1010)).covered_until, at(1000).stamp);
  sweep(reportOf(workpieces_), 1020);
  EXPECT_EQ(levelAt(1020), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, TheProblemsOfMeshesAreThoseThatKeepAWarningFromClear) {
  const auto problems = [&](int ms, const std::vector<std::string>& ids = {}) {
    return monitor_.meshProblems(at(ms), ids);
  };
  EXPECT_EQ(problems(1000), "");
  EXPECT_EQ(problems(1500), "");  // the pose is stale, the mesh is not
  EXPECT_TRUE(has(problems(1501), "'liver' is 0.50 s old"));
  EXPECT_TRUE(has(problems(1501, {"liver"}), "'liver' is 0.50 s old"));
  EXPECT_TRUE(has(problems(1501, {"spleen"}), "no workpiece"));

  monitor_.meshRefused("spleen", "'spleen' refused: NaN vertex", at(1000).steady);
  EXPECT_TRUE(has(problems(1000), "NaN vertex"));
  EXPECT_TRUE(has(problems(1000, {"spleen"}), "NaN vertex"));
  EXPECT_EQ(problems(1000, {"liver"}), "");
  monitor_.meshAccepted("spleen", at(1000).steady);
  monitor_.verticesRefused("liver", "'liver' refused: wrong revision", at(1000).steady);
  EXPECT_TRUE(has(problems(1000, {"spleen", "liver"}), "wrong revision"));
  monitor_.verticesAccepted("liver", at(1000).steady);
  EXPECT_EQ(problems(1000), "");

  monitor_.updateDropped("liver", at(1000).steady);
  EXPECT_TRUE(has(problems(1000, {"liver"}), "dropped"));
  monitor_.setWorkpieces({});
  EXPECT_TRUE(has(problems(1000), "no workpiece"));
  monitor_.setWorkpieces(workpieces_);
  monitor_.require({"liver", "spleen"});
  EXPECT_TRUE(has(problems(1000), "'spleen' has not arrived"));
  EXPECT_EQ(problems(1000, {"liver"}), "");
  monitor_.require({});
  monitor_.meshUnread("vertices of 'ghost' came before their mesh", at(1000).steady);
  EXPECT_TRUE(has(problems(2000), "'ghost'"));
  EXPECT_FALSE(has(problems(2001), "'ghost'"));
}

// A path may be tested while the guard is disabled.
TEST_F(WarningMonitorTest, TheProblemsOfMeshesAreKnownWhileDisabled) {
  monitor_.disable("/somebody");
  EXPECT_EQ(monitor_.meshProblems(at(1000), {}), "");
  monitor_.meshRefused("liver", "'liver' refused: NaN vertex", at(1000).steady);
  EXPECT_TRUE(has(monitor_.meshProblems(at(1000), {"liver"}), "NaN vertex"));
  EXPECT_EQ(reasonsAt(1000), kDisabled);
}

TEST_F(WarningMonitorTest, AFloodOfRefusedMeshesHidesNone) {
  for (int i = 0; i < 1000; ++i) monitor_.meshRefused("ghost" + std::to_string(i), "no mesh", at(1000).steady);
  monitor_.meshRefused("liver", "'liver' refused: NaN vertex", at(1000).steady);
  EXPECT_NE(monitor_.meshProblems(at(1000), {"liver"}), "");
  EXPECT_LT(monitor_.meshProblems(at(1000), {}).size(), 200U);
  EXPECT_LT(warningOf(monitor_, at(1000)).text.size(), 200U);
}

TEST_F(WarningMonitorTest, NewLimitsApplyFromTheNextWarningOn) {
  EXPECT_EQ(levelAt(1050), WarningLevel::kClear);
  WarningLimits limits = kLimits;
  limits.pose_timeout = milliseconds(40);
  monitor_.setLimits(limits);
  EXPECT_NE(reasonsAt(1050) & kPoseStale, 0U);
}

TEST_F(WarningMonitorTest, ADisagreementIsAContactForAWhileAndNotClearUntilRestart) {
  disagree(query(), {3, 5});
  const Warning first = warningOf(monitor_, at(1000));
  EXPECT_EQ(first.level, WarningLevel::kContact);
  EXPECT_EQ(first.triangles, (std::vector<std::uint32_t>{3, 5}));
  EXPECT_NE(first.reasons & kCrosscheck, 0U);
  EXPECT_TRUE(has(first.text, "detectors disagree"));
  EXPECT_EQ(monitor_.meshProblems(at(1000), {}), "detectors disagree");
  sweep(reportOf(workpieces_), 2000);
  EXPECT_EQ(warningOf(monitor_, at(2000)).level, WarningLevel::kUnknown);
  EXPECT_NE(reasonsAt(2000) & kCrosscheck, 0U);
  monitor_.timeJumped("time went back");
  EXPECT_NE(reasonsAt(2000) & kCrosscheck, 0U);
  monitor_.restart();
  EXPECT_EQ(reasonsAt(2000) & kCrosscheck, 0U);
}

// Triangles of a contact that the guard found itself are kept.
TEST_F(WarningMonitorTest, ADisagreementAddsItsTrianglesToTheContact) {
  sweep(reportOf(workpieces_, {2, 4}), 1000);
  disagree(query(), {3, 4});
  EXPECT_EQ(warningOf(monitor_, at(1000)).triangles, (std::vector<std::uint32_t>{2, 3, 4}));
}

TEST_F(WarningMonitorTest, ADisagreementIsNoContactIfItsSweepWasPredictedOrItsTrianglesAreGone) {
  disagree(query(/*measured=*/false), {3});
  EXPECT_EQ(levelAt(1000), WarningLevel::kUnknown);
  EXPECT_NE(reasonsAt(1000) & kCrosscheck, 0U);
  const SampledQuery old = query();
  monitor_.setWorkpieces({workpiece("liver", 1000, /*revision=*/2)});
  disagree(old, {3});
  EXPECT_NE(levelAt(1000), WarningLevel::kContact);
  monitor_.setWorkpieces({});
  disagree(old, {3});
  EXPECT_NE(levelAt(1000), WarningLevel::kContact);
  EXPECT_NE(reasonsAt(1000) & kCrosscheck, 0U);
}

TEST_F(WarningMonitorTest, ADisagreementAboutAQueryFromBeforeARestartDoesNotCount) {
  const SampledQuery before = query();
  disagree(before, {3});
  monitor_.restart();
  monitor_.describeDisagreement("saved", before);
  disagree(before, {3});
  EXPECT_EQ(reasonsAt(1000) & kCrosscheck, 0U);
  EXPECT_NE(levelAt(1000), WarningLevel::kContact);
  disagree(query(), {3});
  monitor_.describeDisagreement("saved", query());
  EXPECT_TRUE(has(warningOf(monitor_, at(1000)).text, "saved"));
}

// The thread that reports it runs when nothing else does.
TEST(DisagreementTest, IsNotPublishedByTheThreadThatReportsIt) {
  int calls = 0;
  WarningMonitor monitor(kLimits, [&] { ++calls; });
  SampledQuery query;
  query.workpiece = workpiece("liver", 1000);
  monitor.detectorsDisagree("detectors disagree", query, {3}, at(1000).steady);
  EXPECT_EQ(calls, 0);
}

TEST_F(WarningMonitorTest, WhatWasSweptByADetectorThatFailedItsTestDoesNotCount) {
  monitor_.detectorTested("");
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
  monitor_.detectorTested("the detector failed");
  sweep(reportOf(workpieces_), 1000);
  monitor_.detectorTested("");
  EXPECT_EQ(levelAt(1000), WarningLevel::kUnknown);
  EXPECT_NE(reasonsAt(1000) & kNoPose, 0U);
  sweep(reportOf(workpieces_), 1000);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, AFailedTestOfTheDetectorLastsUntilOneIsPassed) {
  monitor_.detectorTested("the detector failed");
  EXPECT_EQ(warningOf(monitor_, at(1000)).level, WarningLevel::kUnknown);
  EXPECT_EQ(reasonsAt(1000), kSelftest);
  monitor_.restart();
  EXPECT_NE(reasonsAt(1000) & kSelftest, 0U);
  EXPECT_EQ(monitor_.meshProblems(at(1000), {}), "the detector failed");
  monitor_.detectorTested("");
  EXPECT_EQ(reasonsAt(1000) & kSelftest, 0U);
}

// A contact that is reported while the level is tested is not counted and then hidden.
TEST(DisablingTest, IsOneStepWithTheTestOfTheLevel) {
  const Workpieces workpieces = {workpiece("liver", 1000)};
  SweepReport contact = reportOf(workpieces, {3});
  contact.failures.push_back({workpieces[0], "calls back if the sweep counts"});
  for (int round = 0; round < 500; ++round) {
    static thread_local bool sweeps = false;
    std::atomic<bool> tested = false;
    std::atomic<bool> counted = false;
    const auto on_fault = [&] { counted = counted || sweeps; };
    const auto while_tested = [&]() -> std::optional<SteadyTime> {
      tested = true;
      return std::nullopt;
    };
    WarningMonitor monitor(kLimits, on_fault, while_tested);
    monitor.setWorkpieces(workpieces);
    std::atomic<bool> ready = false;
    std::thread guard([&, round, checkpoint = monitor.checkpoint()] {
      ready = sweeps = true;
      while (!tested) continue;
      for (std::atomic<int> wait = round % 500; wait > 0;) --wait;  // a little later each time
      monitor.swept(contact, timestampsAt(1000), checkpoint, at(1000).steady);
    });
    while (!ready) std::this_thread::yield();
    EXPECT_EQ(monitor.disableBelow(WarningLevel::kReflex, at(1000), "a test"), "");
    guard.join();
    ASSERT_FALSE(counted) << "round " << round;
  }
}

TEST_F(WarningMonitorTest, IsNotDisabledFromALevelOn) {
  sweep(reportOf(workpieces_, {3}), 1000);
  EXPECT_TRUE(has(monitor_.disableBelow(WarningLevel::kReflex, at(1000), "a test"), "CONTACT"));
  EXPECT_FALSE(monitor_.disabledBy());
}

}  // namespace
}  // namespace sweep_guard_core
