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
  for (const auto& one : workpieces) report.objects.push_back({one, {}, {met, 0.0, {}}});
  return report;
}

class LedgerTest : public testing::Test {
 protected:
  // A fresh workpiece, swept at a fresh pose.
  LedgerTest() {
    ledger_.setWorkpieces(workpieces_);
    sweep(reportOf(workpieces_), 1000);
  }

  void sweep(const SweepReport& report, int ms) { ledger_.swept(report, seenAt(ms), ledger_.mark(), at(ms).steady); }

  Level levelAt(int ms) const { return ledger_.verdict(at(ms)).level; }
  std::uint32_t reasonsAt(int ms) const { return ledger_.verdict(at(ms)).reasons; }

  const Workpieces workpieces_ = {workpiece("liver", 1000)};
  Ledger ledger_{kLimits};
};

TEST(EmptyLedgerTest, KnowsNothing) {
  const Verdict verdict = Ledger(kLimits).verdict(at(0));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kNoPose | kNoMesh);
  EXPECT_EQ(verdict.covered_until, Time());
}

TEST_F(LedgerTest, IsClearUntilTheInputsAgeOut) {
  EXPECT_EQ(levelAt(1000), Level::kClear);
  EXPECT_EQ(ledger_.verdict(at(1000)).covered_until, at(1000).stamp);
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
  EXPECT_EQ(told, 2);
  SweepReport failed;
  failed.failures.push_back({workpiece("liver", 1000), "no canary"});
  ledger.swept(failed, seenAt(1000), ledger.mark(), at(1000).steady);
  EXPECT_EQ(told, 3);
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
  EXPECT_EQ(ledger_.verdict(at(1010)).covered_until, at(1000).stamp);
  EXPECT_EQ(ledger_.verdict(at(1010)).pose_stamp, at(1010).stamp);
}

TEST_F(LedgerTest, ANewWorkpieceOrRevisionIsNotClearBeforeItIsSwept) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  ledger_.setWorkpieces(two);
  EXPECT_EQ(reasonsAt(1000), kNotSwept);
  sweep(reportOf(two), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
  ledger_.setWorkpieces({workpieces_[0], workpiece("spleen", 1010, /*revision=*/2)});
  EXPECT_EQ(reasonsAt(1010), kNotSwept);
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
  EXPECT_EQ(reasonsAt(1010), kTimeJump | kNoPose);
  sweep(reportOf(workpieces_), 1010);
  EXPECT_EQ(levelAt(1010), Level::kClear);
}

}  // namespace
}  // namespace sweep_guard
