#include "evaluation/session_count.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/motions.h"
#include "evaluation/random.h"
#include "evaluation/square_obstacle.h"
#include "timeline.h"

namespace sweep_guard_evaluation {
namespace {

using namespace sweep_guard_core::timeline;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::TriangleMesh;
using sweep_guard_core::WarningLevel;
using Levels = std::vector<std::pair<int, WarningLevel>>;

/// The tool moves along x, tip ahead, at 0.1 m/s for 12 s, with a pose every 20 ms.
class SessionCountTest : public testing::Test {
 protected:
  /// Across the path at x = 0.5 m: touched from 5 s, when the tip arrives, to 6 s, when the rear end leaves.
  static SquareObstacle wall() {
    SquareObstacle obstacle;
    obstacle.X_WS.linear() = straightMotion(0.0, seconds(1), seconds(0)).front().X_WT.linear();
    obstacle.X_WS.translation() << 0.5, 0.0, 0.0;
    return obstacle;
  }

  /// Along the path, around x = 0.5 m, at this distance from the side of the tool [m].
  static SquareObstacle sheetBeside(double distance) {
    SquareObstacle obstacle;
    obstacle.X_WS.linear() = Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX()).toRotationMatrix();
    obstacle.X_WS.translation() << 0.5, 0.005 + distance, 0.0;
    return obstacle;
  }

  /// The tip goes to and fro through the wall: touches it during the second half of each period.
  static std::vector<StampedPose> toAndFro(double period) {
    std::vector<StampedPose> poses = straightMotion(0.0, milliseconds(20), seconds(12));
    for (StampedPose& pose : poses) {
      const double time = sweep_guard_core::toSeconds(pose.stamp.time_since_epoch());
      pose.X_WT.translation().x() = 0.4999 - 0.02 * std::sin(2.0 * kPi * time / period);
    }
    return poses;
  }

  std::vector<TimeInterval> touches(const SquareObstacle& obstacle) const {
    const TriangleMesh mesh_W = meshOf(obstacle);
    ObstacleMesh object(tool_, mesh_W);
    return touchesOf(RecordedMotion(poses_), object);
  }

  /// Counts with these levels from these times [ms] on, recorded at every pose.
  SessionCount count(const SquareObstacle& obstacle, const Levels& levels) const {
    const RecordedMotion motion(poses_);
    sweep_guard_recording::LevelTrace trace;
    WarningLevel level = kClear;
    for (const StampedPose& pose : motion.poses()) {
      for (const auto& [from, to] : levels) level = at(from) <= pose.stamp ? to : level;
      trace.add(pose.stamp, level);
    }
    const TriangleMesh mesh_W = meshOf(obstacle);
    ObjectSession object{ObstacleMesh(tool_, mesh_W), {}, {}};
    object.touches = touchesOf(motion, object.mesh);
    countSession(motion, trace, /*measure_near_misses=*/true, object);
    return object.count;
  }

  std::vector<StampedPose> poses_ = straightMotion(0.1, milliseconds(20), seconds(12));
  ConvexShape tool_ = ConvexShape::cylinder(0.005, 0.1);
};

TEST_F(SessionCountTest, ATouchLastsFromTheTipToTheRearEnd) {
  const std::vector<TimeInterval> found = touches(wall());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(sweep_guard_core::toSeconds(found[0].begin.time_since_epoch()), 5.0, 2e-5);
  EXPECT_GE(found[0].end, at(6000));
  EXPECT_LE(found[0].end, at(6006));
  EXPECT_TRUE(touches(sheetBeside(0.001)).empty());
}

TEST_F(SessionCountTest, AContactIsWarnedOfAsEarlyAsTheAlarmThatLastsUntilIt) {
  const SessionCount warned = count(wall(), {{4000, kReflex}, {4200, kClear}, {4460, kConsidered}, {4900, kReflex}});
  EXPECT_EQ(warned.contacts, 1U);
  EXPECT_EQ(warned.warned, (std::array<size_t, 4>{1, 1, 1, 0}));
  EXPECT_EQ(count(wall(), {{4000, kConsidered}, {4980, kClear}}).warned, (std::array<size_t, 4>{0, 0, 0, 0}));
}

TEST_F(SessionCountTest, ReflexComesAtTheLatestWithTheContact) {
  EXPECT_EQ(count(wall(), {{4900, kReflex}}).late, 0U);
  EXPECT_EQ(count(wall(), {{5000, kContact}}).late, 0U);
  EXPECT_EQ(count(wall(), {{5020, kContact}}).late, 1U);
  EXPECT_EQ(count(wall(), {{4000, kConsidered}}).late, 1U);
  EXPECT_EQ(count(wall(), {{4000, kReflex}, {4980, kConsidered}}).late, 1U);
}

TEST_F(SessionCountTest, AnAlarmIsRightIfAContactFollowsItsBeginWithin2sOrWhileItIsOn) {
  EXPECT_EQ(count(wall(), {{3000, kConsidered}, {3200, kClear}}).unjustified, 0U);
  EXPECT_EQ(count(wall(), {{2980, kConsidered}, {3200, kClear}}).unjustified, 1U);
  EXPECT_EQ(count(wall(), {{1000, kConsidered}, {5200, kClear}}).unjustified, 0U);
  EXPECT_EQ(count(wall(), {{6020, kContact}, {6500, kClear}}).unjustified, 0U);  // found by the sweep up to 6.02 s
  EXPECT_EQ(count(wall(), {{6060, kConsidered}, {6500, kClear}}).unjustified, 1U);
}

TEST_F(SessionCountTest, EachAlarmCountsOnceHoweverLongAndReflexCounts) {
  const SessionCount counted = count(
      sheetBeside(0.2),
      {{1000, kConsidered}, {2000, kReflex}, {3000, kConsidered}, {8000, kUnknown}, {8500, kReflex}, {9000, kClear}});
  EXPECT_EQ(counted.alarms, 2U);
  EXPECT_EQ(counted.unjustified, 2U);
  EXPECT_EQ(counted.unjustified_time, milliseconds(7500));
}

TEST_F(SessionCountTest, NearMissesAreCountedByTheirDistance) {
  const Levels alarm = {{4000, kConsidered}, {4500, kClear}};
  EXPECT_EQ(count(sheetBeside(0.007), alarm).near_misses, (std::array<size_t, 3>{1, 1, 1}));
  EXPECT_EQ(count(sheetBeside(0.015), alarm).near_misses, (std::array<size_t, 3>{0, 1, 1}));
  EXPECT_EQ(count(sheetBeside(0.045), alarm).near_misses, (std::array<size_t, 3>{0, 0, 1}));
  EXPECT_EQ(count(sheetBeside(0.055), alarm).near_misses, (std::array<size_t, 3>{0, 0, 0}));
  EXPECT_EQ(count(sheetBeside(0.007), alarm).unjustified, 1U);
}

// At 0.1 m/s the tool is still 0.1 m away 2 s after the begin of the first alarm, and the sheet begins at x = 0.4.
TEST_F(SessionCountTest, ANearMissMayComeUntil2sAfterTheBegin) {
  EXPECT_EQ(count(sheetBeside(0.007), {{1000, kConsidered}, {1500, kClear}}).near_misses[2], 0U);
  EXPECT_EQ(count(sheetBeside(0.007), {{2100, kConsidered}, {2500, kClear}}).near_misses[2], 1U);
}

TEST_F(SessionCountTest, TouchesThatFollowEachOtherWithin2sAreOneContact) {
  poses_ = toAndFro(5.0);  // touches from 2.5 s and from 7.5 s on
  EXPECT_EQ(touches(wall()).size(), 2U);
  EXPECT_EQ(count(wall(), {}).contacts, 2U);
  poses_ = toAndFro(3.9);  // from 1.95 s, too early to be warned of; 5.85 s and 9.75 s: again
  EXPECT_EQ(touches(wall()).size(), 3U);
  EXPECT_EQ(count(wall(), {}).contacts, 0U);
}

TEST_F(SessionCountTest, WhatIsWithin2sOfAGapOrTheEndIsNotCounted) {
  const Levels alarms = {{1000, kConsidered}, {1500, kClear}, {10980, kConsidered}, {11500, kClear}};
  EXPECT_EQ(count(wall(), alarms).alarms, 1U);
  const auto in_gap = [](const StampedPose& pose) { return pose.stamp > at(2800) && pose.stamp < at(3200); };
  poses_.erase(std::remove_if(poses_.begin(), poses_.end(), in_gap), poses_.end());
  EXPECT_EQ(count(wall(), alarms).alarms, 0U);
  EXPECT_EQ(count(wall(), alarms).contacts, 0U);
}

TEST_F(SessionCountTest, AMeshIsTouchedWhileTheTipIsInside) {
  const ConvexShape box = ConvexShape::box({0.2, 0.2, 0.2});
  ObstacleMesh object(tool_, box.mesh_T());
  const ConvexShape needle = ConvexShape::cylinder(0.001, 0.01);
  ObstacleMesh around(needle, box.mesh_T());
  EXPECT_EQ(around.distance(Eigen::Isometry3d::Identity()), 0.0);
  EXPECT_EQ(around.clearance()(Eigen::Isometry3d::Identity()), 0.0);
  const Eigen::Isometry3d outside(Eigen::Translation3d(0.23, 0.0, 0.0));
  EXPECT_NEAR(object.distance(outside), 0.025, 2e-5);
  EXPECT_GT(object.clearance()(outside), 0.0);
  EXPECT_LE(object.clearance()(outside), 0.025);
}

}  // namespace
}  // namespace sweep_guard_evaluation
