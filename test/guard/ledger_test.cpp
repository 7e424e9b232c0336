#include "sweep_guard/guard/ledger.h"

#include <gtest/gtest.h>

namespace sweep_guard {
namespace {

using std::chrono::milliseconds;

constexpr VerdictLimits kLimits = {milliseconds(100), milliseconds(500), milliseconds(500)};

Instant at(int ms) { return {Time(milliseconds(ms)), SteadyTime(milliseconds(ms))}; }
Seen seenAt(int ms) { return {at(ms).stamp, at(ms).steady}; }

std::shared_ptr<const Workpiece> workpiece(const std::string& id, int ms, std::uint32_t revision = 1) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  return std::make_shared<const Workpiece>(Workpiece{id, revision, at(ms).stamp, at(ms).steady, "table", mesh});
}

SweepReport reportOf(const Workpieces& workpieces, const std::vector<std::uint32_t>& met = {}) {
  SweepReport report;
  report.end = at(1000).stamp;
  for (const auto& one : workpieces) report.objects.push_back({one, {}, {met, 0.0, {}, false, met}});
  return report;
}

// From a pose on, 1.1 s ahead in two sweeps.
Outlook outlookOn(const Workpieces& workpieces, int ms) {
  Outlook outlook;
  outlook.stamp = at(ms).stamp;
  outlook.path.resize(2);
  outlook.path[0].ahead = milliseconds(100);
  outlook.path[1].ahead = milliseconds(1100);
  for (const auto& one : workpieces)
    outlook.objects.push_back({one, {{milliseconds(0)}, {milliseconds(100)}}, {}, {}, {}});
  return outlook;
}

// One that meets its first workpiece after so long.
Outlook collisionOn(const Workpieces& workpieces, int ms, int after_ms) {
  Outlook outlook = outlookOn(workpieces, ms);
  outlook.objects[0].sweeps[1] = {milliseconds(after_ms), /*met=*/true, /*probability=*/0.75};
  outlook.objects[0].considered = {4};
  return outlook;
}

class LedgerTest : public testing::Test {
 protected:
  // A fresh workpiece, swept at a fresh pose and looked ahead from there.
  LedgerTest() {
    ledger_.setWorkpieces(workpieces_);
    sweep(reportOf(workpieces_), 1000);
  }

  void sweep(const SweepReport& report, int ms) {
    sweepOnly(report, ms);
    Workpieces tested;
    for (const SweptObject& object : report.objects) tested.push_back(object.workpiece);
    predict(outlookOn(tested, ms), ms);
  }
  void sweepOnly(SweepReport report, int ms) {
    report.end = at(ms).stamp;
    ledger_.swept(report, seenAt(ms), ledger_.mark(), at(ms).steady);
  }
  void predict(const Outlook& outlook, int pose_ms) {
    ledger_.predicted(outlook, seenAt(pose_ms), ledger_.mark(), at(pose_ms));
  }

  Level levelAt(int ms) const { return ledger_.verdict(at(ms)).level; }
  std::uint32_t reasonsAt(int ms) const { return ledger_.verdict(at(ms)).reasons; }

  const Workpieces workpieces_ = {workpiece("liver", 1000)};
  Ledger ledger_{kLimits};
};

TEST_F(LedgerTest, AnOverloadIsToldAndHeldButLeavesTheLevel) {
  SweepReport report = reportOf(workpieces_);
  report.backlog = milliseconds(20);
  sweep(report, 1010);
  EXPECT_EQ(reasonsAt(1010), 0U);
  report.backlog = milliseconds(21);
  sweep(report, 1020);
  sweep(reportOf(workpieces_), 1030);
  EXPECT_EQ(reasonsAt(1030), kOverload);
  EXPECT_EQ(levelAt(1030), Level::kClear);
  sweep(reportOf(workpieces_), 1480);
  EXPECT_EQ(reasonsAt(1480), kOverload);
  ledger_.setWorkpieces({workpiece("liver", 1500)});
  sweep(reportOf({workpiece("liver", 1500)}), 1521);
  EXPECT_EQ(reasonsAt(1521) & kOverload, 0U);
}

TEST_F(LedgerTest, AnOverloadIsForgottenWhenTimeJumps) {
  SweepReport report = reportOf(workpieces_);
  report.backlog = milliseconds(50);
  sweep(report, 1010);
  ledger_.timeJumped("time went back");
  EXPECT_EQ(reasonsAt(1010) & kOverload, 0U);
}

TEST(EmptyLedgerTest, KnowsNothing) {
  const Verdict verdict = Ledger(kLimits).verdict(at(0));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kNoPose | kNoMesh);
  EXPECT_EQ(verdict.covered_until, Time());
}

TEST_F(LedgerTest, IsClearUntilTheInputsAgeOut) {
  EXPECT_EQ(levelAt(1000), Level::kClear);
  EXPECT_EQ(ledger_.verdict(at(1000)).covered_until, at(2100).stamp);
  EXPECT_EQ(levelAt(1100), Level::kClear);
  EXPECT_EQ(reasonsAt(1101), kPoseStale);
  EXPECT_EQ(reasonsAt(1501), kPoseStale | kMeshStale);
}

TEST_F(LedgerTest, AFaultLastsUntilALaterPoseIsSwept) {
  ledger_.fault(kPoseInvalid, "NaN");
  EXPECT_EQ(reasonsAt(1000), kPoseInvalid);
  EXPECT_NE(ledger_.verdict(at(1000)).text.find("NaN"), std::string::npos);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

// A pose that came before the bad one cannot vouch for what came after it.
TEST_F(LedgerTest, AFaultIsNotMendedByWhatCameBeforeIt) {
  const Ledger::Mark before = ledger_.mark();
  ledger_.fault(kPoseInvalid, "NaN");
  ledger_.swept(reportOf(workpieces_), seenAt(1010), before, at(1010).steady);
  EXPECT_EQ(reasonsAt(1010), kPoseInvalid);
}

TEST(LedgerFaultTest, EveryFaultIsToldAtOnce) {
  int told = 0;
  Ledger ledger(kLimits, [&] { ++told; });
  ledger.fault(kPoseInvalid, "NaN");
  EXPECT_EQ(told, 1);
  ledger.meshRefused("liver", "NaN");
  ledger.verticesRefused("liver", "NaN");
  EXPECT_EQ(told, 3);
  SweepReport failed;
  failed.failures.push_back({workpiece("liver", 1000), "no canary"});
  ledger.swept(failed, seenAt(1000), ledger.mark(), at(1000).steady);
  EXPECT_EQ(told, 4);
  Outlook outlook;
  outlook.failures = failed.failures;
  ledger.predicted(outlook, seenAt(1000), ledger.mark(), at(1000));
  EXPECT_EQ(told, 5);
  EXPECT_NE(ledger.verdict(at(1000)).reasons & kDetectorFault, 0U);
}

TEST_F(LedgerTest, ARefusedMeshCountsUntilItsNextGoodOne) {
  ledger_.meshRefused("liver", "NaN vertex");
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  ledger_.meshAccepted("spleen");
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  ledger_.meshAccepted("liver");
  EXPECT_EQ(levelAt(1050), Level::kClear);
}

// What the refused mesh announced is still not seen, however good the vertices of the one before are.
TEST_F(LedgerTest, ARefusedMeshIsNotMendedByVertices) {
  ledger_.meshRefused("liver", "too large");
  ledger_.verticesRefused("liver", "wrong revision");
  ledger_.verticesAccepted("liver");
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  EXPECT_NE(ledger_.verdict(at(1050)).text.find("too large"), std::string::npos);
  ledger_.meshAccepted("liver");
  EXPECT_EQ(levelAt(1050), Level::kClear);
}

TEST_F(LedgerTest, RefusedVerticesAreMendedByGoodOnesAndByAMesh) {
  ledger_.verticesRefused("liver", "NaN vertex");
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  ledger_.verticesAccepted("liver");
  EXPECT_EQ(levelAt(1000), Level::kClear);
  ledger_.verticesRefused("liver", "NaN vertex");
  ledger_.meshAccepted("liver");
  EXPECT_EQ(levelAt(1000), Level::kClear);
}

// Nobody knows where it is: as long as it is neither sent well nor removed, nothing is clear.
TEST_F(LedgerTest, ARefusedMeshOfAnUnknownWorkpieceIsNotForgotten) {
  ledger_.meshRefused("ghost", "NaN vertex");
  EXPECT_NE(reasonsAt(1000000) & kMeshInvalid, 0U);
}

TEST_F(LedgerTest, AFloodOfRefusedMeshesIsNotClearWhenSomeAreMended) {
  for (int i = 0; i < 1000; ++i) ledger_.meshRefused("ghost" + std::to_string(i), "no mesh");
  for (int i = 0; i < 50; ++i) ledger_.meshAccepted("ghost" + std::to_string(i));
  EXPECT_NE(reasonsAt(1000) & kMeshInvalid, 0U);
}

TEST_F(LedgerTest, CoverageEndsWhereAWorkpieceCouldNotBeSwept) {
  SweepReport report = reportOf(workpieces_);
  report.end = at(1010).stamp;
  report.failures.push_back({workpiece("spleen", 1000), "no canary"});
  sweep(report, 1010);
  EXPECT_EQ(ledger_.verdict(at(1010)).covered_until, at(1000).stamp);  // what lies before the prediction is a hole
  EXPECT_EQ(ledger_.verdict(at(1010)).pose_stamp, at(1010).stamp);
}

TEST_F(LedgerTest, ANewWorkpieceOrRevisionIsNotClearBeforeItIsSwept) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  ledger_.setWorkpieces(two);
  EXPECT_EQ(reasonsAt(1000), kNotSwept | kNotCovered);
  sweep(reportOf(two), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
  ledger_.setWorkpieces({workpieces_[0], workpiece("spleen", 1010, /*revision=*/2)});
  EXPECT_EQ(reasonsAt(1010), kNotSwept | kNotCovered);
}

TEST_F(LedgerTest, AContactIsHeldWhileLaterSweepsAreFree) {
  sweep(reportOf(workpieces_, {3, 5}), 1010);
  EXPECT_EQ(levelAt(1000000), Level::kContact);  // as far as is known it lasts
  sweep(reportOf(workpieces_), 1020);
  const Verdict held = ledger_.verdict(at(1510));
  EXPECT_EQ(held.level, Level::kContact);
  EXPECT_EQ(held.mesh_id, "liver");
  EXPECT_EQ(held.triangles, (std::vector<std::uint32_t>{3, 5}));
  EXPECT_NE(levelAt(1511), Level::kContact);
}

TEST_F(LedgerTest, AContactLastsWhileItsWorkpieceCannotBeSwept) {
  sweep(reportOf(workpieces_, {3}), 1010);
  SweepReport failed;
  failed.failures.push_back({workpieces_[0], "no canary"});
  sweep(failed, 1020);
  EXPECT_EQ(levelAt(5000), Level::kContact);
  ledger_.setWorkpieces({});
  sweep({}, 1030);  // it has been removed
  EXPECT_EQ(levelAt(5000), Level::kUnknown);
}

TEST_F(LedgerTest, TimeThatJumpedForgetsPoseAndFaults) {
  ledger_.fault(kTfFail, "no transform");
  ledger_.timeJumped("time went back");
  const Verdict verdict = ledger_.verdict(at(1010));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kTimeJump | kNoPose);
  EXPECT_EQ(verdict.covered_until, Time());
}

TEST_F(LedgerTest, APoseFromBeforeAJumpOfTimeVouchesForNothing) {
  const Ledger::Mark before = ledger_.mark();
  ledger_.timeJumped("time went back");
  ledger_.swept(reportOf(workpieces_), seenAt(1010), before, at(1010).steady);
  ledger_.predicted(collisionOn(workpieces_, 1010, 0), seenAt(1010), before, at(1010));
  EXPECT_EQ(levelAt(1010), Level::kUnknown);
  EXPECT_EQ(reasonsAt(1010), kTimeJump | kNoPose);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

// Poses may come faster than predictions: one serves until the pose that it began at is stale.
TEST_F(LedgerTest, APredictionVouchesForLaterPosesUntilItsOwnIsStale) {
  for (int ms = 1001; ms <= 1100; ++ms) {
    sweepOnly(reportOf(workpieces_), ms);
    ASSERT_EQ(levelAt(ms), Level::kClear) << ms;
  }
  sweepOnly(reportOf(workpieces_), 1101);
  EXPECT_EQ(reasonsAt(1101), kNotCovered);
  EXPECT_EQ(ledger_.verdict(at(1101)).covered_until, at(1101).stamp);
  predict(outlookOn(workpieces_, 1101), 1101);
  EXPECT_EQ(levelAt(1101), Level::kClear);
}

TEST_F(LedgerTest, APredictionThatBeginsBeyondWhatWasSweptLeavesAHole) {
  predict(outlookOn(workpieces_, 1001), 1001);
  EXPECT_EQ(reasonsAt(1001), kNotCovered);
  sweepOnly(reportOf(workpieces_), 1001);
  EXPECT_EQ(levelAt(1001), Level::kClear);
}

TEST_F(LedgerTest, APredictionThatDoesNotReachTheEndOfTheConsideredIntervalIsNotClear) {
  Outlook outlook = outlookOn(workpieces_, 1000);
  outlook.path.pop_back();
  predict(outlook, 1000);
  EXPECT_EQ(reasonsAt(1000), kNotCovered);
  EXPECT_EQ(ledger_.verdict(at(1000)).covered_until, at(1100).stamp);
  outlook.path.clear();
  predict(outlook, 1000);
  EXPECT_EQ(reasonsAt(1000), kNotCovered);
}

TEST_F(LedgerTest, APredictionThatLeftOutAWorkpieceIsNotClear) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  ledger_.setWorkpieces(two);
  sweepOnly(reportOf(two), 1010);
  predict(outlookOn(workpieces_, 1010), 1010);
  EXPECT_EQ(reasonsAt(1010), kNotCovered);
  Outlook unplaced = outlookOn(workpieces_, 1010);
  unplaced.unplaced = {two[1]};
  predict(unplaced, 1010);
  EXPECT_EQ(reasonsAt(1010), kNotCovered);
  predict(outlookOn(two, 1010), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

TEST_F(LedgerTest, AFailedPredictionIsAFaultUntilALaterPose) {
  Outlook failed = outlookOn({}, 1000);
  failed.failures.push_back({workpieces_[0], "no canary"});
  predict(failed, 1000);
  EXPECT_EQ(reasonsAt(1000), kDetectorFault | kNotCovered);
  EXPECT_NE(ledger_.verdict(at(1000)).text.find("no canary"), std::string::npos);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

// No prediction comes between, only time.
TEST_F(LedgerTest, AWarningRisesByItself) {
  predict(collisionOn(workpieces_, 1000, 1050), 1000);
  EXPECT_EQ(levelAt(1034), Level::kClear);
  EXPECT_EQ(levelAt(1035), Level::kConsidered);
  EXPECT_EQ(levelAt(1934), Level::kConsidered);
  EXPECT_EQ(levelAt(1935), Level::kReflex);
  const Verdict verdict = ledger_.verdict(at(1100));
  EXPECT_EQ(verdict.time_to_collision, milliseconds(950));
  EXPECT_EQ(verdict.probability, 0.75);
  EXPECT_EQ(verdict.mesh_id, "liver");
  EXPECT_EQ(verdict.triangles, (std::vector<std::uint32_t>{4}));
}

TEST_F(LedgerTest, AWarningIsHeldFromWhenALaterPredictionIsFree) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  EXPECT_EQ(levelAt(1000), Level::kReflex);
  sweep(reportOf(workpieces_), 1090);
  EXPECT_FALSE(ledger_.verdict(at(1090)).time_to_collision);
  for (int ms = 1100; ms <= 1590; ms += 10) {
    sweep(reportOf(workpieces_), ms);
    ASSERT_EQ(levelAt(ms), Level::kReflex) << ms;
  }
  EXPECT_NE(levelAt(1591), Level::kReflex);
}

// Farther off than before: what was urgent is held, then what is less so.
TEST_F(LedgerTest, AReflexWarningIsHeldWhileAConsideredOneIsInForce) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  for (int ms = 1010; ms <= 1510; ms += 10) {
    sweepOnly(reportOf(workpieces_), ms);
    predict(collisionOn(workpieces_, ms, 500), ms);
    ASSERT_EQ(levelAt(ms), Level::kReflex) << ms;
  }
  EXPECT_EQ(levelAt(1511), Level::kConsidered);
}

TEST_F(LedgerTest, AnExpectationThatWasNeverDueIsNotHeld) {
  predict(collisionOn(workpieces_, 1000, 1050), 1000);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

TEST_F(LedgerTest, AnExpectationStandsWhileItsWorkpieceCannotBeTested) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  Outlook failed = outlookOn({}, 1010);
  failed.failures.push_back({workpieces_[0], "no canary"});
  predict(failed, 1010);
  EXPECT_EQ(ledger_.verdict(at(1010)).time_to_collision, milliseconds(90));
  EXPECT_EQ(levelAt(1000 + 1100 + 500), Level::kReflex);  // to the end of its prediction, and held
  EXPECT_EQ(levelAt(1000 + 1100 + 501), Level::kUnknown);
  ledger_.setWorkpieces({});
  predict(failed, 1020);  // it has been removed
  EXPECT_FALSE(ledger_.verdict(at(1020)).time_to_collision);
}

TEST_F(LedgerTest, AnExpectationThatCannotBeTestedDoesNotHideASoonerOne) {
  const Workpieces two = {workpiece("spleen", 1000), workpieces_[0]};
  ledger_.setWorkpieces(two);
  predict(collisionOn(two, 1000, 300), 1000);
  predict(collisionOn(workpieces_, 1010, 100), 1010);
  EXPECT_EQ(ledger_.verdict(at(1010)).mesh_id, "liver");
  EXPECT_EQ(ledger_.verdict(at(1010)).time_to_collision, milliseconds(100));
}

// Once the prediction is over that the first was expected by, the second is warned of however long the first is lost.
TEST_F(LedgerTest, AnExpectationThatCannotBeTestedDoesNotHideALaterOneForGood) {
  const Workpieces two = {workpiece("spleen", 1000), workpieces_[0]};
  ledger_.setWorkpieces(two);
  predict(collisionOn(two, 1000, 100), 1000);
  for (int ms = 1010; ms <= 5000; ms += 10) {
    const int left = 4500 - ms;
    if (left <= 0) break;
    sweepOnly(reportOf(workpieces_), ms);
    predict(collisionOn(workpieces_, ms, left), ms);
    if (ms > 1000 + 1100 + 500) {
      ASSERT_EQ(levelAt(ms) >= Level::kConsidered, left <= 1015) << ms;
      ASSERT_EQ(levelAt(ms) == Level::kReflex, left <= 115) << ms;
    }
  }
  EXPECT_EQ(ledger_.verdict(at(4490)).mesh_id, "liver");
}

TEST_F(LedgerTest, WarnsOfWhatIsProbableEnough) {
  Outlook outlook = outlookOn(workpieces_, 1000);
  outlook.objects[0].sweeps[1].probability = kLimits.min_probability - 1e-9;
  predict(outlook, 1000);
  EXPECT_EQ(levelAt(1000), Level::kClear);
  outlook.objects[0].sweeps[1].probability = kLimits.min_probability;
  predict(outlook, 1000);
  EXPECT_EQ(levelAt(1000), Level::kReflex);
}

TEST_F(LedgerTest, TimeThatJumpedForgetsWhatWasExpectedAndWarnedOf) {
  predict(collisionOn(workpieces_, 1000, 100), 1000);
  predict(collisionOn(workpieces_, 1010, 500), 1010);
  EXPECT_EQ(levelAt(1010), Level::kReflex);
  ledger_.timeJumped("time went back");
  const Verdict verdict = ledger_.verdict(at(1010));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_FALSE(verdict.time_to_collision);
  sweepOnly(reportOf(workpieces_), 1020);
  EXPECT_EQ(reasonsAt(1020), kNotCovered);
}

TEST_F(LedgerTest, DisabledIsUnknownByWhomItWasAskedWhateverCame) {
  sweep(reportOf(workpieces_, {3}), 1010);
  ledger_.disable("/somebody");
  ledger_.disable("/somebody_else");
  ledger_.fault(kTfFail, "no transform");
  const Verdict verdict = ledger_.verdict(at(1010));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kDisabled);
  EXPECT_EQ(verdict.text, "UNKNOWN: disabled by /somebody: nothing is tested");
  EXPECT_EQ(verdict.covered_until, Time());
}

TEST_F(LedgerTest, WhatCameBeforeOrWhileItWasDisabledDoesNotCount) {
  const Ledger::Mark before = ledger_.mark();
  EXPECT_TRUE(ledger_.counts(before));
  ledger_.disable("/somebody");
  const Ledger::Mark meanwhile = ledger_.mark();
  EXPECT_FALSE(ledger_.counts(before));
  EXPECT_FALSE(ledger_.counts(meanwhile));
  ledger_.enable();
  EXPECT_FALSE(ledger_.counts(before));
  EXPECT_FALSE(ledger_.counts(meanwhile));
  EXPECT_TRUE(ledger_.counts(ledger_.mark()));
  ledger_.swept(reportOf(workpieces_), seenAt(1010), meanwhile, at(1010).steady);
  EXPECT_EQ(reasonsAt(1010), kNoPose);
  sweep(reportOf(workpieces_), 1020);
  EXPECT_EQ(levelAt(1020), Level::kClear);
}

TEST_F(LedgerTest, ToEnableWhatIsEnabledForgetsNothing) {
  ledger_.enable();
  EXPECT_EQ(levelAt(1000), Level::kClear);
}

TEST_F(LedgerTest, RestartEndsWhatIsHeldButNotARefusedMesh) {
  sweep(reportOf(workpieces_, {3}), 1010);
  EXPECT_EQ(levelAt(1010), Level::kContact);
  ledger_.restart();
  EXPECT_EQ(reasonsAt(1010), kNoPose);
  ledger_.meshRefused("liver", "workpiece 'liver' refused");
  ledger_.restart();
  EXPECT_EQ(reasonsAt(1010), kNoPose | kMeshInvalid);
}

TEST_F(LedgerTest, NewLimitsCountFromTheNextVerdictOn) {
  EXPECT_EQ(levelAt(1050), Level::kClear);
  VerdictLimits limits = kLimits;
  limits.pose_timeout = milliseconds(40);
  ledger_.setLimits(limits);
  EXPECT_NE(reasonsAt(1050) & kPoseStale, 0U);
}

}  // namespace
}  // namespace sweep_guard
