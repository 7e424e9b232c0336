#include "sweep_guard/monitor/warning_monitor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "monitor/warning_monitor_fixture.h"

namespace sweep_guard_core {
namespace {

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

TEST_F(WarningMonitorTest, AJumpIsNamedByItsSourceOrByTheFrameOfTheFastest) {
  SweepReport report = reportOf(workpieces_);
  report.jumps = {{"table", {6.0, false}}, {"tray", {12.0, false}}};
  sweep(report, 1010);
  EXPECT_EQ(reasonsAt(1010), kJump);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
  EXPECT_NE(warningOf(monitor_, at(1010)).text.find("the tool jumped against 'tray': 12 m/s"), std::string::npos);
  report.jump = "joint 'elbow' jumped: 130 rad/s";
  sweep(report, 1020);
  EXPECT_NE(warningOf(monitor_, at(1020)).text.find("joint 'elbow'"), std::string::npos);
  sweep(reportOf(workpieces_), 1480);
  EXPECT_EQ(reasonsAt(1480), kJump);
  monitor_.timeJumped("time went back");
  EXPECT_EQ(reasonsAt(1480) & kJump, 0U);
}

TEST_F(WarningMonitorTest, AnOverloadIsForgottenWhenTimeJumps) {
  SweepReport report = reportOf(workpieces_);
  report.backlog = milliseconds(50);
  sweep(report, 1010);
  monitor_.timeJumped("time went back");
  EXPECT_EQ(reasonsAt(1010) & kOverload, 0U);
}

TEST_F(WarningMonitorTest, AnotherToolThatIsSilentOrUnknownIsNotCovered) {
  monitor_.requireTools({"/left"});
  EXPECT_EQ(reasonsAt(1010), kNotCovered | kNotSwept);
  monitor_.toolHeard("/left", timestampsAt(1000));
  monitor_.toolHeard("/right", timestampsAt(1000));
  EXPECT_EQ(levelAt(1100), WarningLevel::kClear);
  sweep(reportOf(workpieces_), 1090);
  EXPECT_EQ(levelAt(1100), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1101), kNotCovered | kNotSwept) << "100 ms after its newest pose";
  EXPECT_NE(monitor_.meshProblems(at(1101), {}), "");
  EXPECT_NE(monitor_.meshProblems(at(1101), {"/left/hand"}), "");
  EXPECT_EQ(monitor_.meshProblems(at(1101), {"liver"}), "");
  monitor_.toolHeard("/left", timestampsAt(1090));
  EXPECT_EQ(levelAt(1101), WarningLevel::kClear);
  monitor_.toolUnknown("/left", "its surface has not come");
  EXPECT_EQ(reasonsAt(1101), kNotCovered | kNotSwept);
  EXPECT_NE(warningOf(monitor_, at(1101)).text.find("tool of '/left': its surface"), std::string::npos);
}

// What moves with another tool has the age of its poses, not that of its shape.
TEST_F(WarningMonitorTest, ALinkOfAnotherToolDoesNotAge) {
  Workpiece link = *workpiece("/left/hand", 100);
  link.of_other_tool = true;
  const Workpieces both = {std::make_shared<const Workpiece>(link), workpieces_[0]};
  monitor_.setWorkpieces(both);
  sweep(reportOf(both), 1000);
  EXPECT_EQ(levelAt(1010), WarningLevel::kClear);
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
  EXPECT_EQ(reasonsAt(1060), 0U) << "what was swept stands in for it";
  EXPECT_EQ(reasonsAt(1061), kNotSwept | kNotCovered);
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

TEST_F(WarningMonitorTest, AContactFromBeforeAJumpOfTimeIsReportedAsOneThatIsOver) {
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  monitor_.timeJumped("time went back");
  monitor_.timeJumped("time went back again");
  EXPECT_TRUE(monitor_.isToBeSwept(before));
  EXPECT_FALSE(monitor_.counts(before));
  monitor_.swept(reportOf(workpieces_, {3}), timestampsAt(1010), before, at(1010).steady);
  EXPECT_EQ(levelAt(1010), WarningLevel::kContact);
  EXPECT_NE(reasonsAt(1010) & kTimeJump, 0U) << "it vouches for nothing else";
  EXPECT_EQ(levelAt(1511), WarningLevel::kUnknown);
}

TEST_F(WarningMonitorTest, WhatWaitsIsNotSweptAfterAnyOtherRestart) {
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  monitor_.restart();
  monitor_.timeJumped("time went back");
  EXPECT_FALSE(monitor_.isToBeSwept(before));
  monitor_.swept(reportOf(workpieces_, {3}), timestampsAt(1010), before, at(1010).steady);
  EXPECT_EQ(levelAt(1010), WarningLevel::kUnknown);
  const WarningMonitor::Checkpoint enabled = monitor_.checkpoint();
  monitor_.disable("a test");
  EXPECT_FALSE(monitor_.isToBeSwept(enabled));
}

TEST_F(WarningMonitorTest, AfterAStaticTransformChangedOnlyLaterPosesAndTheirPredictionsCount) {
  ASSERT_EQ(levelAt(1010), WarningLevel::kClear);
  const WarningMonitor::Checkpoint before = monitor_.checkpoint();
  monitor_.placedAnew("static transform from 'table' to 'world' has changed");
  EXPECT_EQ(reasonsAt(1010), kTimeJump | kNotCovered);
  monitor_.swept(reportOf(workpieces_), timestampsAt(1020), before, at(1020).steady);
  monitor_.predicted(predictionFrom(workpieces_, 1020), timestampsAt(1020), before, at(1020));
  EXPECT_EQ(reasonsAt(1020), kTimeJump | kNotCovered);
  sweepOnly(reportOf(workpieces_), 1030);
  EXPECT_EQ(reasonsAt(1030), kNotCovered);
  monitor_.predicted(predictionFrom(workpieces_, 1020), timestampsAt(1020), before, at(1031));
  EXPECT_EQ(reasonsAt(1031), kNotCovered) << "from a pose before the change";
  predict(predictionFrom(workpieces_, 1030), 1030);
  EXPECT_EQ(levelAt(1031), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, PosesThatWereLeftOutForALateFrameAreUnknownUntilTheNextSweep) {
  SweepReport report = reportOf(workpieces_);
  report.passed_over = {"tray"};
  sweep(report, 1010);
  EXPECT_EQ(reasonsAt(1010), kPosesUnswept);
  EXPECT_NE(warningOf(monitor_, at(1010)).text.find("'tray'"), std::string::npos);
  sweep(reportOf(workpieces_), 1020);
  EXPECT_EQ(levelAt(1020), WarningLevel::kClear);
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

TEST_F(WarningMonitorTest, AConfirmedWorkpieceIsAsYoungAsItsConfirmation) {
  monitor_.confirmed("liver", timestampsAt(1400));
  sweep(reportOf(workpieces_), 1890);
  EXPECT_EQ(levelAt(1900), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1901), kMeshStale);
  EXPECT_EQ(monitor_.heard().at(0).second.stamp, at(1400).stamp);
  monitor_.confirmed("ghost", timestampsAt(1890));
  EXPECT_EQ(monitor_.heard().size(), 1U);
}

// Other workpieces change all the time.
TEST_F(WarningMonitorTest, AConfirmationLastsWhenOtherWorkpiecesChangeAndEndsWithItsWorkpiece) {
  monitor_.confirmed("liver", timestampsAt(1400));
  monitor_.setWorkpieces({workpieces_[0], workpiece("spleen", 1400)});
  EXPECT_EQ(monitor_.heard().at(0).second.stamp, at(1400).stamp);
  monitor_.setWorkpieces({workpiece("liver", 1500), workpiece("spleen", 1400)});
  EXPECT_EQ(monitor_.heard().at(0).second.stamp, at(1500).stamp) << "newer positions";
  monitor_.confirmed("liver", timestampsAt(1600));
  monitor_.setWorkpieces({workpiece("spleen", 1400)});
  monitor_.setWorkpieces({workpieces_[0]});
  EXPECT_EQ(monitor_.heard().at(0).second.stamp, at(1000).stamp);
}

// Its stamp may lie in the future now.
TEST_F(WarningMonitorTest, AConfirmationIsForgottenWhenTimeJumps) {
  monitor_.confirmed("liver", timestampsAt(1400));
  monitor_.timeJumped("time went back");
  monitor_.setWorkpieces(workpieces_);
  EXPECT_EQ(monitor_.heard().at(0).second.stamp, at(1000).stamp);
}

// Its sender says that nothing has changed since; what it sent did not arrive.
TEST_F(WarningMonitorTest, AConfirmationDoesNotExcuseADroppedOrARefusedUpdate) {
  monitor_.updateDropped("liver", at(1100).steady);
  monitor_.confirmed("liver", timestampsAt(1200));
  sweep(reportOf(workpieces_), 1200);
  EXPECT_EQ(reasonsAt(1200), kMeshDropped);
  monitor_.verticesRefused("liver", "vertex 0 is NaN", at(1100).steady);
  monitor_.confirmed("liver", timestampsAt(1300));
  EXPECT_EQ(reasonsAt(1200), kMeshDropped | kMeshInvalid);
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
  disagree(before, {3});
  EXPECT_EQ(reasonsAt(1000) & kCrosscheck, 0U);
  EXPECT_NE(levelAt(1000), WarningLevel::kContact);
  disagree(query(), {3});
  EXPECT_NE(reasonsAt(1000) & kCrosscheck, 0U);
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
  int disabled_first = 0;
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
    const bool disabled = monitor.disableBelow(WarningLevel::kReflex, at(1000), "a test").empty();
    guard.join();
    ASSERT_FALSE(disabled && counted) << "round " << round;
    disabled_first += disabled;
  }
  EXPECT_GT(disabled_first, 0);
}

TEST_F(WarningMonitorTest, IsNotDisabledFromALevelOn) {
  sweep(reportOf(workpieces_, {3}), 1000);
  EXPECT_TRUE(has(monitor_.disableBelow(WarningLevel::kReflex, at(1000), "a test"), "CONTACT"));
  EXPECT_FALSE(monitor_.disabledBy());
}

}  // namespace
}  // namespace sweep_guard_core
