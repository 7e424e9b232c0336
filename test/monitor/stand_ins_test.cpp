// Triangles that were swept and predicted stand in for those that replace them, for 50 ms.
#include "monitor/stand_ins.h"

#include <gtest/gtest.h>

#include "monitor/warning_monitor_fixture.h"

namespace sweep_guard_core {
namespace {

class StandInsTest : public WarningMonitorTest {
 protected:
  // Other triangles each time.
  Workpieces remesh(int ms, std::uint32_t revision = 2) {
    newest_ = {workpiece("liver", ms, revision)};
    monitor_.setWorkpieces(newest_);
    return newest_;
  }

  // A report on the newest triangles, and on those from before.
  static SweepReport reportOfBoth(const Workpieces& newest, const Workpieces& replaced,
                                  const std::vector<std::uint32_t>& met_of_replaced) {
    SweepReport report = reportOf(newest);
    report.replaced = reportOf(replaced, met_of_replaced).objects;
    return report;
  }

  Workpieces newest_ = workpieces_;
};

// Poses come every 10 ms; each is swept 2 ms later, and the prediction is there after another 3 ms.
TEST_F(StandInsTest, TrianglesThatChangeAtAnyRateLeaveTheLevel) {
  for (const int period : {200, 66, 33, 12}) {
    for (int ms = 1000; ms < 3000; ++ms) {
      if (ms % period == period / 2) remesh(ms, static_cast<std::uint32_t>(ms));
      if (ms % 10 == 2) sweepOnly(reportOf(newest_), ms - 2);
      if (ms % 10 == 5) predict(predictionFrom(newest_, ms - 5), ms - 5);
      ASSERT_EQ(reasonsAt(ms), 0U) << ms << " ms, every " << period << " ms";
      ASSERT_EQ(levelAt(ms), WarningLevel::kClear) << ms << " ms, every " << period << " ms";
    }
    monitor_.restart();
    sweep(reportOf(remesh(1000)), 1000);
  }
}

TEST_F(StandInsTest, ThoseThatAreNeverSweptAreUnknownAfterAWhileHoweverManyCome) {
  for (int ms = 1010; ms <= 1060; ms += 5) {
    remesh(ms);
    EXPECT_EQ(levelAt(ms), WarningLevel::kClear) << ms;
  }
  EXPECT_EQ(reasonsAt(1061), kNotSwept | kNotCovered);
  EXPECT_TRUE(has(warningOf(monitor_, at(1061)).text, "workpiece 'liver' not swept yet"));
  EXPECT_EQ(warningOf(monitor_, at(1061)).covered_until, at(1000).stamp);
}

TEST_F(StandInsTest, ThoseThatAreSweptAndNeverPredictedAreUnknownAfterAWhile) {
  for (int ms = 1010; ms <= 1060; ms += 10) sweepOnly(reportOf(remesh(ms)), ms);
  EXPECT_EQ(levelAt(1060), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1061), kNotCovered);
  predict(predictionFrom(newest_, 1060), 1060);
  EXPECT_EQ(levelAt(1061), WarningLevel::kClear);
}

// The prediction began before the others came.
TEST_F(StandInsTest, APredictionThatEndsAfterTheOthersCameStandsInAsLongAsItsTriangles) {
  const Workpieces before = newest_;
  sweepOnly(reportOf(remesh(1010)), 1012);
  predict(predictionFrom(before, 1005), 1005);
  EXPECT_EQ(levelAt(1060), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1061), kNotCovered);
}

TEST_F(StandInsTest, TheTimeCountsFromWhenTheOthersAreThere) {
  monitor_.setWorkpieces({workpiece("liver", 1010)}, at(1030).steady);
  EXPECT_EQ(levelAt(1080), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1081), kNotSwept | kNotCovered);
}

TEST_F(StandInsTest, AContactWithThoseBeforeLastsUntilTheOthersAreSwept) {
  sweep(reportOf(workpieces_, {0}), 1010);
  const Workpieces before = newest_;
  remesh(1015);
  EXPECT_EQ(levelAt(1016), WarningLevel::kContact);
  EXPECT_EQ(levelAt(1300), WarningLevel::kContact) << "as far as is known it lasts";
  sweepOnly(reportOfBoth(newest_, before, {0}), 1320);
  EXPECT_FALSE(warningOf(monitor_, at(1320)).held_since);
  sweepOnly(reportOf(newest_), 1330);
  EXPECT_EQ(warningOf(monitor_, at(1330)).held_since, at(1320).stamp);
  EXPECT_EQ(levelAt(1820), WarningLevel::kContact);
  EXPECT_NE(levelAt(1821), WarningLevel::kContact);
}

TEST_F(StandInsTest, ThoseBeforeThatAreMetOnTheWayToThePoseAreAContact) {
  const Workpieces before = newest_;
  sweepOnly(reportOfBoth(remesh(1005), before, {0}), 1010);
  const Warning warning = warningOf(monitor_, at(1010));
  EXPECT_EQ(warning.level, WarningLevel::kContact);
  EXPECT_EQ(warning.mesh_id, "liver");
  EXPECT_EQ(warning.triangles, (std::vector<std::uint32_t>{0}));
}

TEST_F(StandInsTest, AContactWithTheOthersAloneCounts) {
  const Workpieces before = newest_;
  remesh(1005);
  EXPECT_EQ(levelAt(1009), WarningLevel::kClear);
  SweepReport report = reportOfBoth(newest_, before, {});
  report.objects[0].result.not_ruled_out = {0};
  sweepOnly(report, 1010);
  EXPECT_EQ(levelAt(1010), WarningLevel::kContact);
  EXPECT_EQ(levelAt(1011), WarningLevel::kContact);
}

TEST_F(StandInsTest, AWarningOfThoseBeforeStaysUntilTheOthersArePredicted) {
  predict(collisionOn(workpieces_, 1000, 500), 1000);
  sweepOnly(reportOf(remesh(1010)), 1012);
  EXPECT_EQ(levelAt(1012), WarningLevel::kConsidered);
  EXPECT_FALSE(warningOf(monitor_, at(1012)).held_since);
  predict(predictionFrom(newest_, 1012), 1012);
  EXPECT_TRUE(warningOf(monitor_, at(1012)).held_since);
}

TEST_F(StandInsTest, EndAtOnceWhereTheWorkpieceIsRemovedMeanwhile) {
  remesh(1005);
  monitor_.setWorkpieces({});
  EXPECT_EQ(reasonsAt(1006), kNoMesh);
  remesh(1007);
  EXPECT_EQ(reasonsAt(1007), kNotSwept | kNotCovered);
}

TEST_F(StandInsTest, EndAtOnceWhereTheFrameIsAnother) {
  Workpiece moved = *workpiece("liver", 1005);
  moved.frame = "turntable";
  monitor_.setWorkpieces({std::make_shared<const Workpiece>(moved)});
  EXPECT_EQ(reasonsAt(1005), kNotSwept | kNotCovered);
  remesh(1006);
  EXPECT_EQ(reasonsAt(1006), kNotSwept | kNotCovered);
}

// The number that the sender gives does not count: it may have started anew.
TEST_F(StandInsTest, DoNotDependOnTheRevision) {
  sweep(reportOf(remesh(1005, /*revision=*/7)), 1010);
  remesh(1015, /*revision=*/1);
  EXPECT_EQ(levelAt(1065), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1066), kNotSwept | kNotCovered);
  sweep(reportOf(newest_), 1070);
  remesh(1075, /*revision=*/1);
  EXPECT_EQ(levelAt(1080), WarningLevel::kClear);
}

TEST_F(StandInsTest, AreThoseOfTheirOwnWorkpiece) {
  Workpieces two = {workpieces_[0], workpiece("spleen", 1000)};
  monitor_.setWorkpieces(two);
  sweep(reportOf(two), 1010);
  two[1] = workpiece("spleen", 1015, /*revision=*/2);
  monitor_.setWorkpieces(two);
  EXPECT_EQ(levelAt(1065), WarningLevel::kClear);
  EXPECT_EQ(reasonsAt(1066), kNotSwept | kNotCovered);
  EXPECT_TRUE(has(warningOf(monitor_, at(1066)).text, "workpiece 'spleen' not swept yet"));
  EXPECT_FALSE(has(warningOf(monitor_, at(1066)).text, "workpiece 'liver'"));
  two.push_back(workpiece("tendon", 1016));
  monitor_.setWorkpieces(two);
  EXPECT_EQ(reasonsAt(1016), kNotSwept | kNotCovered) << "nothing stands in for a new one";
}

TEST_F(StandInsTest, HideNoOtherReason) {
  sweep(reportOf(remesh(1005)), 1010);
  remesh(1015);
  monitor_.fault(kTfFail, "no transform");
  EXPECT_EQ(reasonsAt(1016), kTfFail);
  monitor_.updateDropped("liver", at(1016).steady);
  EXPECT_EQ(reasonsAt(1016), kTfFail | kMeshDropped);
  monitor_.meshRefused("liver", "NaN", at(1016).steady);
  EXPECT_EQ(reasonsAt(1016), kTfFail | kMeshDropped | kMeshInvalid);
  EXPECT_NE(reasonsAt(1111) & kPoseStale, 0U);
}

TEST_F(StandInsTest, AreForgottenWithWhatWasSwept) {
  remesh(1005);
  monitor_.timeJumped("time went back");
  EXPECT_NE(reasonsAt(1006) & kNoPose, 0U);
  sweepOnly(reportOf({}), 1007);
  EXPECT_NE(reasonsAt(1007) & kNotSwept, 0U);
}

TEST_F(StandInsTest, KeepNoTrianglesInMemory) {
  std::vector<ReplacedTriangles> replaced;
  Workpieces before = {workpiece("liver", 1000)};
  const Workpieces after = {workpiece("liver", 1010)};
  updateStandIns(before, after, at(1010).steady, replaced);
  EXPECT_EQ(standInUntil(replaced, before, *after[0]), at(1010).steady + kStandInTime);
  const std::weak_ptr<const Workpiece> watched = before[0];
  const std::weak_ptr<const std::vector<Triangle>> triangles = before[0]->mesh_M.sharedTriangles();
  before.clear();
  EXPECT_TRUE(watched.expired());
  EXPECT_TRUE(triangles.expired());
  EXPECT_FALSE(standInUntil(replaced, before, *after[0]));
}

}  // namespace
}  // namespace sweep_guard_core
