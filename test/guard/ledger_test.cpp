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
  for (const auto& one : workpieces) report.objects.push_back({one, {}, {met, 0.0, {}}});
  return report;
}

class LedgerTest : public testing::Test {
 protected:
  // A fresh workpiece, swept at a fresh pose.
  LedgerTest() {
    ledger_.setWorkpieces(workpieces_);
    ledger_.swept(reportOf(workpieces_), seenAt(1000), at(1000).steady);
  }

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

TEST_F(LedgerTest, AFaultLastsUntilItIsMended) {
  ledger_.fault(kDetectorFault, "no canary");
  EXPECT_EQ(reasonsAt(1000), kDetectorFault);
  EXPECT_NE(ledger_.verdict(at(1000)).text.find("no canary"), std::string::npos);
  ledger_.mend(kPoseInvalid, ledger_.faultCount());
  EXPECT_EQ(reasonsAt(1000), kDetectorFault);
  ledger_.mend(kDetectorFault, ledger_.faultCount());
  EXPECT_EQ(levelAt(1000), Level::kClear);
}

// A pose that came before the bad one cannot vouch for what came after it.
TEST_F(LedgerTest, AFaultIsNotMendedByWhatCameBeforeIt) {
  const std::uint64_t before = ledger_.faultCount();
  ledger_.fault(kPoseInvalid, "NaN");
  ledger_.mend(kPoseInvalid, before);
  EXPECT_EQ(reasonsAt(1000), kPoseInvalid);
}

TEST_F(LedgerTest, ARefusedMeshCountsUntilItsNextGoodOne) {
  ledger_.meshRefused("liver", "NaN vertex", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  ledger_.meshAccepted("spleen");
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  ledger_.meshAccepted("liver");
  EXPECT_EQ(levelAt(1050), Level::kClear);
}

TEST_F(LedgerTest, ARefusedMeshOfAnUnknownWorkpieceCountsForASecond) {
  ledger_.meshRefused("ghost", "its vertices came, but not its mesh", at(1000).steady);
  EXPECT_NE(reasonsAt(2000) & kMeshInvalid, 0U);
  EXPECT_EQ(reasonsAt(2001) & kMeshInvalid, 0U);
}

TEST_F(LedgerTest, AFloodOfUnknownWorkpiecesDoesNotHideAKnownFault) {
  ledger_.meshRefused("liver", "NaN vertex", at(1000).steady);
  for (int i = 0; i < 1000; ++i) ledger_.meshRefused("zombie" + std::to_string(i), "no mesh", at(1000).steady);
  EXPECT_NE(reasonsAt(3000) & kMeshInvalid, 0U);
}

TEST_F(LedgerTest, ANewWorkpieceOrRevisionIsNotClearBeforeItIsSwept) {
  const Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  ledger_.setWorkpieces(two);
  EXPECT_EQ(reasonsAt(1000), kNotSwept);
  ledger_.swept(reportOf(two), seenAt(1010), at(1010).steady);
  EXPECT_EQ(levelAt(1010), Level::kClear);
  ledger_.setWorkpieces({workpieces_[0], workpiece("spleen", 1010, /*revision=*/2)});
  EXPECT_EQ(reasonsAt(1010), kNotSwept);
}

TEST_F(LedgerTest, AContactIsHeldWhileLaterSweepsAreFree) {
  ledger_.swept(reportOf(workpieces_, {3, 5}), seenAt(1010), at(1010).steady);
  ledger_.swept(reportOf(workpieces_), seenAt(1020), at(1020).steady);
  const Verdict held = ledger_.verdict(at(1510));
  EXPECT_EQ(held.level, Level::kContact);
  EXPECT_EQ(held.mesh_id, "liver");
  EXPECT_EQ(held.triangles, (std::vector<std::uint32_t>{3, 5}));
  EXPECT_NE(levelAt(1511), Level::kContact);
}

TEST_F(LedgerTest, TimeThatJumpedForgetsPoseContactAndFaults) {
  ledger_.swept(reportOf(workpieces_, {3}), seenAt(1010), at(1010).steady);
  ledger_.fault(kTfFail, "no transform");
  ledger_.timeJumped("time went back");
  const Verdict verdict = ledger_.verdict(at(1010));
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kTimeJump | kNoPose);
}

}  // namespace
}  // namespace sweep_guard
