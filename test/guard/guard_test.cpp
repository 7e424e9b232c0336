#include "guard/guard_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "guard/fake_detector.h"
#include "guard/moving_mesh.h"
#include "guard/times.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Indices = std::vector<std::uint32_t>;

using Places = std::map<std::string, Eigen::Isometry3d>;

// The tool at a place in each frame. Only the motion between them counts: the tool rests in W, the frames move.
PoseWithFrames pose(double seconds, const Places& X_MT) {
  PoseWithFrames pose{atSecond(seconds), SteadyTime(fromSeconds(seconds)), Eigen::Isometry3d::Identity(), {}};
  for (const auto& [frame, X] : X_MT) pose.X_WM[frame] = X.inverse();
  return pose;
}

// One triangle of a metre in the plane z = 0 of its frame.
std::shared_ptr<const Workpiece> triangleIn(const std::string& id, const std::string& frame) {
  return std::make_shared<const Workpiece>(Workpiece{id, 0, atSecond(0.0), SteadyTime{}, frame,
                                                     TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}})});
}

// A drill that is 0.1 m long and guarded in the frame `table`, unless stated otherwise.
class GuardTest : public testing::Test {
 protected:
  SweepReport sweepTo(double seconds, double z) { return reportOf(guard_, pose(seconds, {{"table", up(z)}}), table_); }

  void passTo(double seconds, double z) { guard_.pass(pose(seconds, {{"table", up(z)}})); }

  const Workpieces table_ = {triangleIn("triangle", "table")};
  FakeDetector::Record record_;
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<FakeDetector>(record_), {}};
};

TEST_F(GuardTest, TestsTheFirstPoseAlone) {
  const SweepReport report = sweepTo(1.0, 0.5);
  EXPECT_EQ(report.start, atSecond(1.0));
  EXPECT_EQ(report.end, atSecond(1.0));
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.0));
  EXPECT_FALSE(report.contact());
  ASSERT_EQ(record_.volumes.size(), 1U);
  EXPECT_NEAR(record_.volumes[0].box.half_extents.z(), 0.05, 1e-9);  // no longer than the drill
}

TEST_F(GuardTest, FindsAContactAtTheFirstPose) {
  const SweepReport report = sweepTo(1.0, 0.05);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.objects[0].result.triangles, Indices{0});
}

// The drill ends 0.05 m over the triangle.
TEST_F(GuardTest, KnowsWhetherTheToolAtTheNewestPoseIsWithinADistance) {
  EXPECT_FALSE(guard_.isWithin(1.0, *table_[0]));
  sweepTo(1.0, -0.5);
  sweepTo(1.1, 0.15);
  EXPECT_FALSE(guard_.isWithin(0.0499, *table_[0]));
  EXPECT_TRUE(guard_.isWithin(0.0501, *table_[0]));
  EXPECT_FALSE(guard_.isWithin(1.0, *triangleIn("triangle", "elsewhere")));
  sweepTo(1.2, 0.25);
  EXPECT_FALSE(guard_.isWithin(0.0501, *table_[0]));
}

// The triangle is between the poses, and touches the drill at neither.
TEST_F(GuardTest, SweepsFromPoseToPose) {
  EXPECT_FALSE(sweepTo(1.0, 0.5).contact());
  const SweepReport report = sweepTo(1.1, -0.1);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, atSecond(1.0));
  EXPECT_EQ(report.end, atSecond(1.1));
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.0));
  EXPECT_EQ(report.objects[0].workpiece, table_[0]);
  EXPECT_FALSE(sweepTo(1.2, -0.2).contact());
}

// The drill passes 3 mm beside the triangle's edge.
TEST_F(GuardTest, AToolThatJointsMoveIsSweptWithItsDeviation) {
  const auto besideAt = [](double seconds, double z, double deviation_bound) {
    PoseWithFrames beside = pose(seconds, {{"table", Eigen::Isometry3d(Eigen::Translation3d(0, -1.008, z))}});
    beside.bodies = {{beside.X_WT, deviation_bound}};
    return beside;
  };
  reportOf(guard_, besideAt(1.0, 0.5, 0.0), table_);
  EXPECT_FALSE(reportOf(guard_, besideAt(1.1, -0.1, 0.002), table_).contact());
  EXPECT_TRUE(reportOf(guard_, besideAt(1.2, 0.5, 0.004), table_).contact());
  guard_.pass(besideAt(1.3, -0.1, 0.004));
  EXPECT_TRUE(reportOf(guard_, besideAt(1.4, -0.2, 0.0), table_).contact());
  guard_.pass(besideAt(1.5, 0.5, 0.002));
  EXPECT_FALSE(reportOf(guard_, besideAt(1.6, 0.6, 0.0), table_).contact());
}

TEST_F(GuardTest, SweepsEveryIntervalEndToEnd) {
  sweepTo(0.0, 1.0);
  for (int i = 1; i <= 20; ++i) {
    const SweepReport report = sweepTo(0.01 * i, 1.0 - 0.1 * i);
    EXPECT_EQ(report.start, atSecond(0.01 * (i - 1)));
    EXPECT_EQ(report.end, atSecond(0.01 * i));
    // From the tip now to the far end before: 0.2 m, about the tip before.
    EXPECT_NEAR(record_.volumes.back().box.half_extents.z(), 0.1, 1e-6);
    EXPECT_NEAR(record_.volumes.back().box.X_MB.translation().z(), 1.0 - 0.1 * i, 1e-6);
  }
}

// The drill of 5 mm passes the triangle's edge in 7 mm.
TEST_F(GuardTest, ContinuesTheSweepWithAnExchangedToolAndDetector) {
  reportOf(guard_, pose(1.0, {{"table", Eigen::Isometry3d(Eigen::Translation3d(0.0, -1.007, 0.5))}}), table_);
  FakeDetector::Record record;
  GuardChange change;
  change.bodies = {Tool::cylinder(0.01, 0.1)};
  change.detector = std::make_unique<FakeDetector>(record);
  change.options.sweep.volume = VolumeKind::kObb;
  guard_.exchange(change);
  ASSERT_TRUE(change.detector);
  EXPECT_NEAR(change.bodies[0].bounds_T().max().x(), 0.005, 1e-9);
  record_.volumes.clear();
  const Eigen::Isometry3d below(Eigen::Translation3d(0.0, -1.007, -0.5));
  const SweepReport report = reportOf(guard_, pose(1.1, {{"table", below}}), table_);
  EXPECT_EQ(report.start, atSecond(1.0));
  EXPECT_TRUE(report.contact());
  EXPECT_TRUE(record_.volumes.empty());
  ASSERT_FALSE(record.volumes.empty());
  EXPECT_TRUE(record.volumes[0].clips_B.empty());
}

// The first detector misses the surface that the tool goes through.
TEST_F(GuardTest, DoesNotTrustThatTheToolIsOutsideAfterADetectorWasExchanged) {
  const Workpieces sphere = {std::make_shared<const Workpiece>(
      Workpiece{"sphere", 1, Time(), {}, "table", wavyHull(/*rings=*/8, /*sectors=*/12, /*phase=*/0.0)})};
  const auto moved = [](double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)); };
  FakeDetector::Record blind;
  blind.drop_every = 1;
  Guard guard(Tool::cylinder(0.001, 0.002), std::make_unique<FakeDetector>(blind), {});
  reportOf(guard, pose(1.0, {{"table", moved(1.0)}}), sphere);
  EXPECT_FALSE(reportOf(guard, pose(1.1, {{"table", moved(0.0)}}), sphere).contact());
  GuardChange change;
  change.detector = std::make_unique<FakeDetector>(record_);
  guard.exchange(change);
  EXPECT_TRUE(reportOf(guard, pose(1.2, {{"table", moved(0.0)}}), sphere).contact());
}

// Else nothing would be known of what comes for two poses.
TEST_F(GuardTest, PredictsWithAnExchangedPredictorFromTheNextPoseOn) {
  sweepTo(1.0, 0.5);
  GuardChange change;
  change.predictor.emplace(PredictorOptions());
  guard_.exchange(change);
  EXPECT_TRUE(predictionOf(guard_, {}, table_).path.empty());
  sweepTo(1.1, 0.5);
  EXPECT_FALSE(predictionOf(guard_, {}, table_).path.empty());
}

TEST_F(GuardTest, SweepsBetweenTwoPosesOfTheSameStamp) {
  sweepTo(1.0, 0.5);
  const SweepReport report = sweepTo(1.0, -0.1);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, report.end);
}

TEST_F(GuardTest, LeavesTheIntervalOfAFailedSweepToTheNext) {
  sweepTo(1.0, 0.5);
  record_.failures_left = 1;
  const SweepReport failed = sweepTo(1.1, -0.1);
  ASSERT_EQ(failed.failures.size(), 1U);
  EXPECT_EQ(failed.failures[0].workpiece, table_[0]);
  EXPECT_TRUE(failed.objects.empty());
  EXPECT_FALSE(failed.complete());
  const SweepReport report = sweepTo(1.2, -0.2);
  EXPECT_TRUE(report.contact());
  EXPECT_TRUE(report.complete());
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.0));
}

TEST_F(GuardTest, GivesUpSweepsAndPredictionsOnceItIsStopped) {
  sweepTo(1.0, 0.5);
  sweepTo(1.1, 0.5);
  guard_.stop();
  record_.volumes.clear();
  EXPECT_EQ(sweepTo(1.2, 0.5).failures.size(), 1U);
  EXPECT_EQ(predictionOf(guard_, {}, table_).failures.size(), 1U);
  EXPECT_TRUE(record_.volumes.empty());
}

// Down through the triangle and up again: the straight history from first to last is free.
TEST_F(GuardTest, SweepsThroughEveryPoseSinceAFailure) {
  sweepTo(1.0, 0.5);
  record_.failures_left = 2;
  sweepTo(1.1, 0.3);
  sweepTo(1.2, -0.1);
  const SweepReport report = sweepTo(1.3, 0.5);
  EXPECT_TRUE(report.contact());
  EXPECT_FALSE(sweepTo(1.4, 0.6).contact());
}

// The drill's far end is at the triangle 2/3 through the first of the intervals, which lasts 0.1 s of 1 s.
TEST_F(GuardTest, TimesOfImpactAreFractionsOfTheTimeAfterAFailureToo) {
  sweepTo(1.0, 0.5);
  record_.failures_left = 1;
  sweepTo(1.1, -0.1);
  const SweepReport report = sweepTo(2.0, -0.2);
  ASSERT_EQ(report.objects[0].result.in_contact.size(), 1U);
  EXPECT_NEAR(report.objects[0].result.in_contact[0].impact.time_of_impact, 0.4 / 0.6 * 0.1, 1e-6);
}

// Down at a growing speed, until the detector answers again: the segments are merged, the time counts by theirs. At 1 m/s
// a deviation_bound of a ten-thousandth of a metre makes it early by 0.2 ms at the most.
TEST_F(GuardTest, TimesOfImpactOnMergedSegmentsAreNotLate) {
  const auto z = [](int ms) { return 0.3 - 1e-3 * ms - 1e-6 * ms * ms; };
  const double met_ms = 0.5 * (std::sqrt(1e6 + 4e6 * 0.2) - 1e3);
  for (int last = 172; last < 200; ++last) {
    guard_.reset();
    sweepTo(1.0, z(0));
    record_.failures_left = last - 1;
    for (int ms = 1; ms < last; ++ms) sweepTo(1.0 + 1e-3 * ms, z(ms));
    const SweepResult found = sweepTo(1.0 + 1e-3 * last, z(last)).objects[0].result;
    EXPECT_LT(found.volumes_M.size(), 20U);
    ASSERT_EQ(found.in_contact.size(), 1U);
    EXPECT_LE(found.in_contact[0].impact.time_of_impact * last, met_ms);
    EXPECT_GE(found.in_contact[0].impact.time_of_impact * last, met_ms - 0.2);
  }
}

TEST_F(GuardTest, SweepsThePathAcrossAFailureThoughTheTrianglesAreNew) {
  const Workpieces remeshed = {triangleIn("triangle", "table")};
  sweepTo(1.0, 0.5);
  record_.failures_left = 1;
  sweepTo(1.1, -0.2);
  EXPECT_TRUE(reportOf(guard_, pose(1.2, {{"table", up(-0.3)}}), remeshed).contact());
}

// Of two triangles at a height in the frame `table`.
std::shared_ptr<const Workpiece> quadAt(double z, std::uint32_t revision) {
  const TriangleMesh mesh_M({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, {{0, 1, 2}, {0, 2, 3}});
  return std::make_shared<const Workpiece>(
      Workpiece{"triangle", revision, atSecond(1.05), SteadyTime{}, "table", mesh_M});
}

TEST_F(GuardTest, SweepsTrianglesThatWereReplacedToTheNextPoseAndNoFarther) {
  const Workpieces far = {quadAt(-5.0, 1)};
  sweepTo(1.0, 0.2);
  const SweepReport both = reportOf(guard_, pose(1.1, {{"table", up(-0.2)}}), far);
  ASSERT_EQ(both.objects.size(), 1U);
  EXPECT_FALSE(both.objects[0].result.contact());
  ASSERT_EQ(both.replaced.size(), 1U);
  EXPECT_EQ(both.replaced[0].workpiece, table_[0]);
  EXPECT_EQ(both.replaced[0].interval_start, atSecond(1.0));
  EXPECT_EQ(both.replaced[0].result.triangles, Indices{0});
  EXPECT_TRUE(both.contact());
  EXPECT_TRUE(both.complete());
  const SweepReport next = reportOf(guard_, pose(1.2, {{"table", up(0.2)}}), far);
  EXPECT_TRUE(next.replaced.empty());
  EXPECT_FALSE(next.contact());
}

TEST_F(GuardTest, FindsAContactWithNewTrianglesBesideThoseThatWereReplaced) {
  sweepTo(1.0, 0.5);
  const SweepReport both = reportOf(guard_, pose(1.1, {{"table", up(0.5)}}), {quadAt(0.45, 1)});
  ASSERT_EQ(both.replaced.size(), 1U);
  EXPECT_FALSE(both.replaced[0].result.contact());
  EXPECT_TRUE(both.objects[0].result.contact());
}

// A tool that rests on the triangles meets those from before and the new ones.
TEST_F(GuardTest, FindsContactsWithTheTrianglesFromBeforeAndTheNewOnes) {
  sweepTo(1.0, 0.05);
  const SweepReport both = reportOf(guard_, pose(1.1, {{"table", up(0.05)}}), {quadAt(0.0, 1)});
  ASSERT_EQ(both.replaced.size(), 1U);
  EXPECT_TRUE(both.replaced[0].result.contact());
  EXPECT_TRUE(both.objects[0].result.contact());
}

TEST_F(GuardTest, SweepsReplacedTrianglesAgainAfterAFailureOrWhereTheReportWasLost) {
  const Workpieces far = {quadAt(-5.0, 1)};
  sweepTo(1.0, 0.2);
  record_.failures_left = 100;
  const SweepReport failed = reportOf(guard_, pose(1.1, {{"table", up(-0.2)}}), far);
  record_.failures_left = 0;
  EXPECT_TRUE(failed.replaced.empty());
  EXPECT_FALSE(failed.failures.empty());
  EXPECT_FALSE(failed.complete());
  EXPECT_TRUE(reportOf(guard_, pose(1.2, {{"table", up(-0.2)}}), far).contact());
  guard_.takeBack();
  const SweepReport again = reportOf(guard_, pose(1.3, {{"table", up(-0.2)}}), far);
  EXPECT_TRUE(again.contact());
  EXPECT_EQ(again.start, atSecond(1.0));
  EXPECT_FALSE(reportOf(guard_, pose(1.4, {{"table", up(-0.2)}}), far).contact());
}

TEST_F(GuardTest, ForgetsReplacedTrianglesOfAWorkpieceThatIsRemovedOrComesInAnotherFrame) {
  sweepTo(1.0, 0.2);
  EXPECT_TRUE(reportOf(guard_, pose(1.1, {}), {quadAt(-5.0, 1)}).replaced.empty()) << "its frame is unknown";
  EXPECT_TRUE(reportOf(guard_, pose(1.2, {{"table", up(-0.2)}}), {}).replaced.empty());
  EXPECT_FALSE(reportOf(guard_, pose(1.3, {{"table", up(-0.2)}}), {quadAt(-5.0, 2)}).contact());
  const SweepReport moved =
      reportOf(guard_, pose(1.4, {{"turntable", up(0.5)}}), {triangleIn("triangle", "turntable")});
  EXPECT_TRUE(moved.replaced.empty());
  EXPECT_FALSE(moved.contact());
}

// The tool goes through the triangles while their frame is not known, and they are replaced meanwhile.
TEST_F(GuardTest, SweepsReplacedTrianglesOnceTheirFrameIsKnown) {
  const Workpieces far = {quadAt(-5.0, 1)};
  sweepTo(1.0, 0.2);
  reportOf(guard_, pose(1.1, {}), far);
  EXPECT_TRUE(reportOf(guard_, pose(1.2, {{"table", up(-0.2)}}), far).contact());
}

TEST_F(GuardTest, AFailureOnOneWorkpieceDoesNotHideAContactWithAnother) {
  const Workpieces both = {triangleIn("first", "table"), triangleIn("second", "table")};
  record_.failures_left = 1;
  const SweepReport report = reportOf(guard_, pose(1.0, {{"table", up(0.05)}}), both);
  ASSERT_EQ(report.failures.size(), 1U);
  EXPECT_EQ(report.failures[0].workpiece, both[0]);
  EXPECT_TRUE(report.contact());
}

TEST_F(GuardTest, PassesThroughABacklogInOneSweep) {
  sweepTo(1.0, 0.5);
  record_.volumes.clear();
  for (int ms = 1; ms < 40; ++ms) passTo(1.0 + 1e-3 * ms, 0.5 - 1e-3 * ms);
  EXPECT_TRUE(record_.volumes.empty());
  const SweepReport report = sweepTo(1.04, 0.46);
  EXPECT_EQ(record_.volumes.size(), 1U);
  EXPECT_NEAR(record_.volumes[0].box.half_extents.z(), 0.07, 1e-6);
  EXPECT_EQ(report.start, atSecond(1.0));
  EXPECT_EQ(report.end, atSecond(1.04));
  EXPECT_NEAR(toSeconds(report.backlog), 0.039, 1e-9);
  const SweepReport next = sweepTo(1.041, 0.46);
  EXPECT_EQ(next.start, atSecond(1.04));
  EXPECT_EQ(next.backlog, Duration::zero());
}

// The poses of 0.1 s, or of 30 s, that one message makes known have not waited: so do a root at 100 Hz and joints at 10 Hz.
TEST_F(GuardTest, ABacklogIsTheTimeThatPosesWaitedWhateverTheirStamps) {
  for (const double step : {0.001, 0.01, 3.0}) {
    guard_.reset();
    sweepTo(1.0, 0.5);
    PoseWithFrames known = pose(1.0, {{"table", up(0.5)}});
    known.received += std::chrono::milliseconds(5);
    for (int i = 1; i < 10; ++i) {
      known.stamp = atSecond(1.0 + step * i);
      guard_.pass(known);
    }
    known.stamp = atSecond(1.0 + step * 10);
    EXPECT_EQ(reportOf(guard_, known, table_).backlog, Duration::zero()) << step;
    guard_.pass(known);
    known.received += std::chrono::milliseconds(30);
    EXPECT_EQ(reportOf(guard_, known, table_).backlog, std::chrono::milliseconds(30)) << "of one stamp";
  }
}

// A millisecond down and one up again, wherever in the backlog.
TEST_F(GuardTest, FindsTheContactOfAFlickInABacklog) {
  for (int flick = 1; flick < 100; ++flick) {
    SCOPED_TRACE("flick at " + std::to_string(flick) + " ms");
    guard_.reset();
    EXPECT_FALSE(sweepTo(1.0, 0.5).contact());
    for (int ms = 1; ms < 100; ++ms) passTo(1.0 + 1e-3 * ms, ms == flick ? -0.2 : 0.5);
    const SweepReport report = sweepTo(1.1, 0.5);
    ASSERT_TRUE(report.contact());
    const double first_ms = 100 * report.objects[0].result.in_contact[0].impact.time_of_impact;
    EXPECT_NEAR(first_ms, flick - 1 + 0.4 / 0.7, 1e-6);
  }
}

TEST_F(GuardTest, SweepsTheWholeBacklogForAWorkpieceThatArrivesDuringIt) {
  reportOf(guard_, pose(1.0, {{"table", up(0.5)}}), {});
  passTo(1.1, -0.2);
  passTo(1.2, -0.5);
  EXPECT_TRUE(sweepTo(1.3, -0.6).contact());
}

TEST_F(GuardTest, SweepsABacklogWhereItsFrameIsKnownAgain) {
  sweepTo(1.0, 0.5);
  passTo(1.1, -0.2);
  const SweepReport unplaced = reportOf(guard_, pose(1.2, {}), table_);
  EXPECT_EQ(unplaced.unplaced.size(), 1U);
  passTo(1.3, 0.4);
  const SweepReport report = sweepTo(1.4, 0.5);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, atSecond(1.0));
}

TEST_F(GuardTest, SweepsTheBacklogOfAWorkpieceWhoseFrameWasMissingAtItsFirstSweep) {
  passTo(1.0, 0.5);
  passTo(1.1, -0.2);
  passTo(1.2, 0.4);
  const SweepReport unplaced = reportOf(guard_, pose(1.3, {}), table_);
  EXPECT_EQ(unplaced.unplaced.size(), 1U);
  const SweepReport report = sweepTo(1.4, 0.5);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, atSecond(1.0));
}

TEST_F(GuardTest, ABacklogLeavesThePredictionAsItIs) {
  GuardOptions options;
  options.clock = [] { return SteadyTime(); };
  Guard backlogged(Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), options);
  Guard prompt(Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), options);
  for (int ms = 0; ms <= 300; ++ms) {
    const PoseWithFrames pose{atSecond(1.0 + 1e-3 * ms), SteadyTime{}, up(0.5 + 0.1 * std::sin(0.01 * ms)), {}};
    reportOf(prompt, pose, {});
    if (ms % 10 == 0) {
      reportOf(backlogged, pose, {});
    } else {
      backlogged.pass(pose);
    }
  }
  const PredictedPath expected = prompt.predictMotion({}, fromSeconds(1.0)).path;
  const PredictedPath path = backlogged.predictMotion({}, fromSeconds(1.0)).path;
  ASSERT_EQ(path.size(), expected.size());
  for (size_t i = 0; i < path.size(); ++i) EXPECT_EQ(path[i].X_WT.matrix(), expected[i].X_WT.matrix());
}

// A static transform of the table changes on the way from one pose to the next: that way counts in both places.
class PlacedAnewTest : public GuardTest {
 protected:
  struct Way {
    double from;
    double to;
  };
  SweepReport sweepBoth(const Way& before, const Way& after) {
    sweepTo(1.0, before.from);
    passTo(1.1, before.to);
    PoseWithFrames anew = pose(1.1, {{"table", up(after.from)}});
    anew.anew = PlacedAnew{false, {"table"}};
    guard_.pass(anew);
    return sweepTo(1.1, after.to);
  }
};

TEST_F(PlacedAnewTest, WhatIsCrossedInTheOldPlaceIsFound) {
  const SweepReport report = sweepBoth({0.2, -0.05}, {0.5, 0.4});
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, atSecond(1.0));
}

TEST_F(PlacedAnewTest, WhatIsCrossedInTheNewPlaceIsFound) {
  EXPECT_TRUE(sweepBoth({0.5, 0.4}, {0.2, -0.05}).contact());
}

TEST_F(PlacedAnewTest, TheMoveItselfIsNoMotion) {
  EXPECT_FALSE(sweepBoth({0.5, 0.4}, {-0.2, -0.3}).contact());
  EXPECT_FALSE(sweepTo(1.2, -0.4).contact());
  EXPECT_TRUE(sweepTo(1.3, 0.3).contact());
}

TEST_F(PlacedAnewTest, WhereTheToolTouchesInBothPlacesBothCount) {
  const SweepReport report = sweepBoth({0.5, 0.05}, {0.05, 0.5});
  EXPECT_TRUE(report.contact());
  EXPECT_FALSE(sweepTo(1.2, 0.5).contact());
}

TEST_F(PlacedAnewTest, AFailedSweepIsRepeatedInBothPlaces) {
  sweepTo(1.0, 0.2);
  passTo(1.1, -0.05);
  PoseWithFrames anew = pose(1.1, {{"table", up(0.5)}});
  anew.anew = PlacedAnew{false, {"table"}};
  guard_.pass(anew);
  record_.failures_left = 1;
  EXPECT_EQ(sweepTo(1.1, 0.4).failures.size(), 1U);
  EXPECT_TRUE(sweepTo(1.2, 0.4).contact());
}

// Elsewhere the tool does not go back to the pose before.
TEST_F(PlacedAnewTest, OtherFramesAreNotConcerned) {
  const Workpieces both = {triangleIn("one", "shelf"), triangleIn("two", "table")};
  reportOf(guard_, pose(1.0, {{"shelf", up(0.5)}, {"table", up(0.5)}}), both);
  PoseWithFrames anew = pose(1.1, {{"shelf", up(-0.5)}, {"table", up(0.8)}});
  anew.anew = PlacedAnew{false, {"table"}};
  guard_.pass(anew);
  EXPECT_FALSE(reportOf(guard_, pose(1.1, {{"shelf", up(0.5)}, {"table", up(0.7)}}), both).contact());
}

TEST_F(PlacedAnewTest, OnlyThePredictorOfWhatMovedForgets) {
  const auto tool_at = [](double seconds, double x) {
    return PoseWithFrames{atSecond(seconds), SteadyTime{}, along(x), {{"table", up(-5.0)}}};
  };
  const auto predicts_after = [&](const PlacedAnew& what) {
    guard_.reset();
    for (int i = 0; i < 5; ++i) reportOf(guard_, tool_at(1.0 + 0.01 * i, 0.01 * i), table_);
    PoseWithFrames anew = tool_at(1.05, 0.04);
    anew.anew = what;
    guard_.pass(anew);
    reportOf(guard_, tool_at(1.05, 0.05), table_);
    return !guard_.predictMotion({}, std::chrono::milliseconds(500)).path.empty();
  };
  EXPECT_TRUE(predicts_after({false, {"table"}}));
  EXPECT_FALSE(predicts_after({true, {}}));
  reportOf(guard_, tool_at(1.06, 0.06), table_);
  EXPECT_FALSE(guard_.predictMotion({}, std::chrono::milliseconds(500)).path.empty());
}

// A plate whose transforms come 60 ms late. The tool rests, the plate moves up through it and down again.
TEST_F(GuardTest, SweepsOnWhenAFrameIsKnownFurther) {
  const auto plate_at = [](double seconds, double z) { return FramePose{atSecond(seconds), up(z)}; };
  FrameMotion plate{{plate_at(0.99, -0.5)}, {}, {}, true};
  const auto follow = [&] {
    guard_.follow(
        std::make_shared<const FrameMotions>(FrameMotions{{"table", std::make_shared<const FrameMotion>(plate)}}));
  };
  follow();
  SweepReport report;
  for (int i = 0; i < 8; ++i) report = reportOf(guard_, pose(1.0 + 0.01 * i, {}), table_);
  EXPECT_EQ(report.unplaced, table_) << "no time is known of both";
  for (const auto& [seconds, z, contact] :
       std::vector<std::tuple<double, double, bool>>{{1.01, -0.4, false}, {1.04, 0.1, true}, {1.06, 0.2, false}}) {
    plate.measured.push_back(plate_at(seconds, z));
    follow();
    guard_.sweep(pose(1.07, {}), table_, report, /*arrived=*/false);
    ASSERT_EQ(report.objects.size(), 1U);
    EXPECT_EQ(report.contact(), contact) << "up to " << seconds << " s";
    EXPECT_EQ(report.end, atSecond(1.07));
  }
}

// The table turns by half a radian about its own origin, the tool rests a metre away: relative to the table it runs along
// an arc that deviates by a metre times 0.25 / 8 = 31 mm from the straight path. Something stands on that arc.
TEST_F(GuardTest, SweepsTheArcThatATurningTableMakesOfARestingTool) {
  const auto tableTurnedBy = [](double angle) {
    PoseWithFrames pose{
        atSecond(1.0 + angle), SteadyTime{}, Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0)), {}};
    pose.X_WM["table"] = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ());
    return pose;
  };
  const Eigen::Vector3d on_arc(std::cos(0.25), std::sin(0.25), -0.05);
  const TriangleMesh dot({on_arc, on_arc, on_arc}, {{0, 1, 2}});
  const Workpieces table = {
      std::make_shared<const Workpiece>(Workpiece{"dot", 0, atSecond(0.0), SteadyTime{}, "table", dot})};
  EXPECT_FALSE(reportOf(guard_, tableTurnedBy(0.0), table).contact());
  EXPECT_TRUE(reportOf(guard_, tableTurnedBy(0.5), table).contact());
}

TEST_F(GuardTest, TestsThePoseAloneAfterAReset) {
  sweepTo(1.0, 0.5);
  guard_.reset();
  const SweepReport report = sweepTo(0.3, -0.1);
  EXPECT_FALSE(report.contact());
  EXPECT_EQ(report.objects[0].interval_start, atSecond(0.3));
}

TEST_F(GuardTest, HasNothingToReportWithoutWorkpieces) {
  const SweepReport report = reportOf(guard_, pose(1.0, {{"table", up(0.0)}}), {});
  EXPECT_TRUE(report.objects.empty());
  EXPECT_TRUE(report.unplaced.empty());
  EXPECT_FALSE(report.contact());
  EXPECT_EQ(report.margin(), 0.0);
}

TEST_F(GuardTest, NamesWorkpiecesWhoseFrameIsMissing) {
  const Workpieces both = {triangleIn("on table", "table"), triangleIn("on turntable", "turntable")};
  const SweepReport report = reportOf(guard_, pose(1.0, {{"table", up(0.5)}}), both);
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.objects[0].workpiece, both[0]);
  ASSERT_EQ(report.unplaced.size(), 1U);
  EXPECT_EQ(report.unplaced[0], both[1]);
}

// For one pose the turntable's transform is missing. The next sweep there starts at the pose before.
TEST_F(GuardTest, SweepsFromTheLastPoseThatWasKnownInAFrame) {
  const Workpieces both = {triangleIn("on table", "table"), triangleIn("on turntable", "turntable")};
  reportOf(guard_, pose(1.0, {{"table", up(0.5)}, {"turntable", up(0.5)}}), both);
  reportOf(guard_, pose(1.1, {{"table", up(0.4)}}), both);
  const SweepReport report = reportOf(guard_, pose(1.2, {{"table", up(0.3)}, {"turntable", up(-0.1)}}), both);
  ASSERT_EQ(report.objects.size(), 2U);
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.1));
  EXPECT_TRUE(report.objects[0].result.triangles.empty());
  EXPECT_EQ(report.objects[1].interval_start, atSecond(1.0));
  EXPECT_EQ(report.objects[1].result.triangles, Indices{0});
  EXPECT_EQ(report.start, atSecond(1.0));
  EXPECT_TRUE(report.contact());
}

// The tool rests in the world; the workpiece's frame comes up and passes it.
TEST_F(GuardTest, MeetsAWorkpieceThatMovesWithItsFrame) {
  const Eigen::Isometry3d X_WT = up(0.0);
  const auto toolIn = [&](const Eigen::Isometry3d& X_WM) { return X_WM.inverse() * X_WT; };
  reportOf(guard_, pose(1.0, {{"table", toolIn(up(-0.5))}}), table_);
  EXPECT_TRUE(reportOf(guard_, pose(1.1, {{"table", toolIn(up(0.5))}}), table_).contact());
}

// A pose is remembered in every frame, so a workpiece that comes later is swept over the interval it came in.
TEST_F(GuardTest, SweepsAWorkpieceThatComesLaterFromThePoseBefore) {
  reportOf(guard_, pose(1.0, {{"table", up(0.5)}}), {});
  const SweepReport report = sweepTo(1.1, -0.1);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.0));
}

// What comes to live in a frame later was not there when the tool moved before.
TEST_F(GuardTest, ForgetsAFrameThatNothingLivesIn) {
  sweepTo(1.0, 0.5);
  reportOf(guard_, pose(1.1, {}), {});
  const SweepReport report = sweepTo(1.2, -0.1);
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.2));
  EXPECT_FALSE(report.contact());
}

TEST_F(GuardTest, ReportsTheLargestMargin) {
  record_.inflation = 0.125;
  EXPECT_NEAR(sweepTo(1.0, 0.5).margin(), 0.125, 1e-9);
}

// One triangle at different heights; only update() makes a later workpiece of an earlier one.
class MovingWorkpieceTest : public testing::Test {
 protected:
  static TriangleMesh flat() { return TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

  void place(double seconds, double z) {
    std::vector<float> positions;
    const TriangleMesh before = newest_ ? newest_->mesh_M : flat();
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = before.vertex(i);
      for (const double x : {p.x(), p.y(), z}) positions.push_back(static_cast<float>(x));
    }
    const auto next = std::make_shared<Workpiece>(
        Workpiece{"triangle", 0, atSecond(seconds), SteadyTime{}, "table", deformed(before, positions)});
    if (newest_) countUpdate(*newest_, *next);
    newest_ = next;
  }

  // The triangle lies below, and the tool is at a height.
  void beginAt(double z) {
    place(1.0, -1.0);
    sweepTo(1.0, z);
  }

  SweepReport sweepTo(double seconds, double z) {
    return reportOf(guard_, pose(seconds, {{"table", up(z)}}), {newest_});
  }

  std::shared_ptr<const Workpiece> newest_;
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), {}};
};

TEST_F(MovingWorkpieceTest, ThatJumpsOverARestingToolIsReported) {
  place(1.0, -1.0);
  EXPECT_FALSE(sweepTo(1.0, 0.0).contact());
  place(1.01, 1.0);
  const SweepReport report = sweepTo(1.01, 0.0);
  EXPECT_TRUE(report.contact());
  const SweepResult& found = report.objects[0].result;
  EXPECT_EQ(found.not_ruled_out, Indices{0});
  ASSERT_EQ(found.in_contact.size(), 1U);
  EXPECT_NEAR(found.in_contact[0].impact.time_of_impact, 0.45, 1e-6);  // 0.9 m of 2 m to the far end of the drill
  EXPECT_LT(report.margin(), 1e-6);                                    // it went as a whole
  EXPECT_FALSE(sweepTo(1.02, 0.0).contact());
}

TEST_F(MovingWorkpieceTest, ThatStaysBelowIsNotMet) {
  beginAt(0.0);
  place(1.01, -0.2);
  EXPECT_FALSE(sweepTo(1.01, 0.0).contact());
}

// Up and down again between two sweeps: only how far it went in all tells.
TEST_F(MovingWorkpieceTest, ThatIsBackBeforeTheNextSweepIsReported) {
  beginAt(0.0);
  place(1.004, 0.5);
  place(1.008, -1.0);
  const SweepReport report = sweepTo(1.01, 0.0);
  EXPECT_TRUE(report.contact());
  EXPECT_GT(report.margin(), 1.4);
}

// While the triangle came up, the tool was below it for a moment, and is above it again when the update arrives.
TEST_F(MovingWorkpieceTest, IsMetWhereTheToolWasMeanwhile) {
  beginAt(0.5);
  sweepTo(1.01, -0.5);
  sweepTo(1.02, 2.0);
  sweepTo(1.03, 2.0);
  place(1.025, 0.0);
  const SweepReport report = sweepTo(1.04, 2.0);
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.objects[0].interval_start, atSecond(1.03));
}

// 16 ms at 1 kHz: one sweep for what was, and one for what is new.
TEST_F(MovingWorkpieceTest, TakesOneMoreSweepAfterASmoothMotion) {
  beginAt(0.5);
  for (int ms = 1; ms <= 16; ++ms) sweepTo(1.0 + 1e-3 * ms, 0.5 - 2e-4 * ms - 1e-6 * ms * ms);
  place(1.015, -0.9);
  const SweepReport report = sweepTo(1.017, 0.49);
  EXPECT_EQ(report.objects[0].result.volumes_M.size(), 2U);
  EXPECT_FALSE(report.contact());
}

// The tool was down for a moment only, a millisecond there and one back.
TEST_F(MovingWorkpieceTest, IsMetByAFlickBeforeItsUpdate) {
  for (int flick = 1; flick < 16; ++flick) {
    SCOPED_TRACE("flick at " + std::to_string(flick) + " ms");
    newest_.reset();
    guard_.reset();
    place(1.0, -1.0);
    for (int ms = 0; ms <= 16; ++ms) EXPECT_FALSE(sweepTo(1.0 + 1e-3 * ms, ms == flick ? -0.3 : 0.5).contact());
    place(1.016, -0.35);
    EXPECT_TRUE(sweepTo(1.017, 0.5).contact());
  }
}

// Updates of the triangle arrive before the poses: it is not there yet when the tool passes.
TEST_F(MovingWorkpieceTest, IsMetByPosesOlderThanItsUpdate) {
  beginAt(0.5);
  place(1.1, -1.5);
  place(1.2, -3.0);
  EXPECT_FALSE(sweepTo(1.01, 0.5).contact());
  EXPECT_TRUE(sweepTo(1.02, -1.2).contact());
  EXPECT_FALSE(sweepTo(1.3, 0.5).contact() && sweepTo(1.31, -1.2).contact());
}

// An update has the history before swept again, where the drill was not in as deep.
TEST_F(MovingWorkpieceTest, HasDepthsOfTheNewestPoseAtItsUpdatesToo) {
  place(1.0, 0.0);
  for (int i = 0; i < 20; ++i) {
    const double z = 0.1 - 0.004 * i;
    if (i % 5 == 4) place(1.0 + 0.01 * i, i % 2 == 0 ? 1e-6 : 0.0);
    const SweepReport report = sweepTo(1.0 + 0.01 * i, z);
    ASSERT_EQ(report.objects[0].result.in_contact.size(), 1U);
    EXPECT_NEAR(report.objects[0].result.in_contact[0].impact.depth, 0.1 - z, 2e-6);
  }
}

TEST_F(MovingWorkpieceTest, ThatRestsIsNotSweptAgain) {
  beginAt(0.5);
  sweepTo(1.01, 0.4);
  place(1.015, -1.0);
  const SweepReport report = sweepTo(1.02, 0.3);
  EXPECT_EQ(report.objects[0].result.volumes_M.size(), 1U);
}

TEST_F(MovingWorkpieceTest, IsFollowedThroughAFailureOfTheFirstSweep) {
  FakeDetector::Record record;
  record.failures_left = 1;
  Guard guard{Tool::cylinder(0.005, 0.1), std::make_unique<FakeDetector>(record), {}};
  place(1.0, 0.0);
  EXPECT_EQ(reportOf(guard, pose(1.0, {{"table", up(0.5)}}), {newest_}).failures.size(), 1U);
  EXPECT_TRUE(reportOf(guard, pose(1.1, {{"table", up(-0.5)}}), {newest_}).contact());
}

// The clock of the poses is 10 s behind that of the mesh: each pose would need every update since.
TEST_F(MovingWorkpieceTest, KeepsABoundedNumberOfUpdatesForPosesThatAreFarBehind) {
  for (const double period : {1e-3, 1e-4}) {
    newest_.reset();
    guard_.reset();
    std::vector<std::weak_ptr<const Workpiece>> updates;
    for (int i = 0; i < 3000; ++i) {
      place(11.0 + period * i, -1.0);
      updates.push_back(newest_);
      sweepTo(1.0 + period * i, 0.5);
    }
    const auto kept =
        std::count_if(updates.begin(), updates.end(), [](const auto& update) { return !update.expired(); });
    EXPECT_LE(kept, 514);
  }
}

// It trembles by a micrometre, 1 mm below the drill. In 10 s that is a path of 10 mm: it might have gone 5 mm aside.
TEST_F(MovingWorkpieceTest, IsNotMetMillimetresEarlyByPosesThatAreFarBehind) {
  for (int i = 0; i < 4000; ++i) {
    place(11.0 + 1e-3 * i, i % 2 == 0 ? -1e-3 : -1e-3 - 1e-6);
    const SweepReport report = sweepTo(1.0 + 1e-3 * i, 0.1);
    ASSERT_FALSE(report.contact()) << i;
    ASSERT_LT(report.margin(), 0.3e-3) << i;
  }
}

TEST_F(MovingWorkpieceTest, SaysHowFarThePosesAreBehindIt) {
  Duration largest{};
  for (int i = 0; i < 1000; ++i) {
    place(11.0 + 1e-3 * i, -1.0);
    const SweepReport report = sweepTo(1.0 + 1e-3 * i, 0.5);
    const bool behind = report.objects[0].behind > Duration::zero();
    EXPECT_EQ(behind, i > 501) << i;
    EXPECT_EQ(report.complete(), !behind);
    largest = std::max(largest, report.objects[0].behind);
  }
  EXPECT_NEAR(toSeconds(largest), 9.5, 0.01);
}

TEST_F(MovingWorkpieceTest, IsNeverFarAheadOfPosesWithinHalfASecond) {
  for (const int mesh_period : {1, 16, 1000}) {
    for (const int pose_period : {1, 10, 50}) {
      for (const double skew : {-0.5, -0.1, 0.0, 0.02, 0.2, 0.445}) {
        newest_.reset();
        guard_.reset();
        for (int ms = 0; ms < 4000; ++ms) {
          if (ms % mesh_period == 0) place(10.0 + skew + 1e-3 * ms, -1.0 - 1e-5 * ms);
          if (ms % pose_period != 0) continue;
          const SweepReport report = sweepTo(10.0 + 1e-3 * ms, 0.5);
          ASSERT_EQ(report.objects[0].behind, Duration::zero())
              << "updates every " << mesh_period << " ms, poses every " << pose_period << " ms, " << skew << " s ahead";
          ASSERT_TRUE(report.complete());
        }
      }
    }
  }
}

// As a publisher does that sends the whole mesh each time.
TEST_F(MovingWorkpieceTest, IsFollowedThoughItsTrianglesAreSentAnew) {
  beginAt(0.0);
  const TriangleMesh anew({{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {{0, 1, 2}});
  newest_ =
      std::make_shared<const Workpiece>(Workpiece{"triangle", 0, atSecond(1.01), SteadyTime{}, "table", anew, 1, 2.0});
  EXPECT_TRUE(sweepTo(1.01, 0.0).contact());
}

}  // namespace
}  // namespace sweep_guard_core
