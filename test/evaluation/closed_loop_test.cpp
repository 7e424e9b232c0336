#include "evaluation/closed_loop.h"

#include <gtest/gtest.h>

#include "evaluation/closed_loop_episode.h"
#include "evaluation/motions.h"
#include "evaluation/square_at.h"

namespace sweep_guard_evaluation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using sweep_guard_core::Twist;

constexpr double kLength = 0.1;

Isometry3d at(double x) {
  Isometry3d X = straightMotion(0.0, milliseconds(20), milliseconds(0))[0].X_WT;
  X.translation().x() = x;
  return X;
}

// A tool that points along x, its tip at the origin, before a wall across x.
class ClosedLoopTest : public testing::Test {
 protected:
  static LoopScene wallAt(double x) {
    return {sweep_guard_core::Tool::cylinder(0.005, kLength), squareAt({x, 0.0, 0.0}, Vector3d::UnitX(), 0.1)};
  }
  static ClosedLoop loopBefore(LoopScene& scene, const SurfaceVelocity& surface = {}) {
    return {scene, surface, {Time(seconds(10)), {}, SimulatedRobot(at(0.0), {})}, 0.002};
  }
  // Pushes along x; returns the first contact.
  static std::optional<LoopCycle::Contact> push(ClosedLoop& loop, double speed, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const LoopCycle cycle = loop.run({{speed, 0.0, 0.0}, Vector3d::Zero()});
      if (cycle.contact) return cycle.contact;
    }
    return {};
  }
};

TEST_F(ClosedLoopTest, WithoutAGuardTheToolRunsIntoTheWallAtItsSpeed) {
  LoopScene scene = wallAt(0.1);
  ClosedLoop loop = loopBefore(scene);
  const auto contact = push(loop, 0.2, 100);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->closing_speed, 0.2, 1e-6);
  EXPECT_EQ(contact->closing_speed, contact->tool_speed);
}

TEST_F(ClosedLoopTest, WithAGuardItStopsAtTheStandoff) {
  LoopScene scene = wallAt(0.1);
  ClosedLoop loop = loopBefore(scene);
  DelayedGuardOptions guard;
  guard.motion.dead_time = RobotOptions{}.dead_time;
  guard.motion.time_constant = RobotOptions{}.lag;
  loop.addGuard(guard);
  EXPECT_FALSE(push(loop, 0.2, 400));
  const double gap = scene.separationAt(loop.X_MT()).gap;
  EXPECT_GT(gap, 0.002);
  EXPECT_LT(gap, 0.002 / 0.95 + 1e-4);
}

TEST_F(ClosedLoopTest, AContactBetweenTwoPosesIsFoundBySweeping) {
  LoopScene scene{sweep_guard_core::Tool::cylinder(0.005, kLength), squareAt({0.0, 0.0, 0.0}, Vector3d::UnitY(), 0.05)};
  Isometry3d before = at(0.0);
  Isometry3d after = at(0.0);
  before.translation().y() = -0.006;
  after.translation().y() = 0.006;
  const std::vector<double> gaps = {scene.separationAt(before).gap, scene.separationAt(after).gap};
  EXPECT_GT(gaps[0], 0.0);
  EXPECT_GT(gaps[1], 0.0);
  EXPECT_EQ(scene.firstContact({before, after}, gaps), 0U);
  EXPECT_FALSE(scene.firstContact({before, before}, {gaps[0], gaps[0]}));
}

TEST_F(ClosedLoopTest, ASurfaceThatComesReachesAToolAtRest) {
  LoopScene scene = wallAt(0.05);
  ClosedLoop loop = loopBefore(scene, {{-0.1, 0.0, 0.0}, Time(seconds(10))});
  loop.addGuard({});
  const auto contact = push(loop, 0.0, 100);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->closing_speed, 0.1, 1e-9);
  EXPECT_EQ(contact->tool_speed, 0.0);
}

// Of a hand that goes through a figure of eight for a minute.
class ClosedLoopEpisodeTest : public testing::Test {
 protected:
  ClosedLoopEpisodeTest() : driven_(drive(RecordedMotion(winding()), setup_.robot)) {
    for (const ObstaclePlacement& placement : placeObstacles(RecordedMotion(driven_.path), setup_.shape, 24, 1)) {
      const auto begin = beginOf(driven_, placement, setup_);
      if (!begin) continue;
      placed_.push_back(placement);
      placements_.push_back({placement.obstacle, *begin, placement.end, placement.contact});
    }
  }

  ClosedLoopOptions setup_;
  DrivenRobot driven_;
  std::vector<ObstaclePlacement> placed_;
  std::vector<ObstaclePlacement> placements_;  // the same from where their episodes begin
};

TEST_F(ClosedLoopEpisodeTest, TheGuardKeepsTheToolOffEverySquareThatItRunsIntoWithoutIt) {
  size_t met = 0;
  for (const ObstaclePlacement& placement : placements_) {
    met += runEpisode(driven_, placement, setup_, {/*surface_comes=*/false, false, 1}).contact ? 1 : 0;
    const ClosedLoopEpisode guarded = runEpisode(driven_, placement, setup_, {/*surface_comes=*/false, true, 1});
    EXPECT_FALSE(guarded.contact);
    EXPECT_LT(guarded.standoff_speed, 0.001);
    EXPECT_EQ(guarded.free_changed, 0U);
    for (const Retreat& retreat : guarded.retreats) EXPECT_FALSE(retreat.contact);
  }
  EXPECT_GE(met, 10U);
}

TEST_F(ClosedLoopEpisodeTest, WithoutAGuardTheContactIsWhereThePlacementHasIt) {
  for (const ObstaclePlacement& placement : placements_) {
    const ClosedLoopEpisode episode = runEpisode(driven_, placement, setup_, {/*surface_comes=*/false, false, 1});
    EXPECT_EQ(episode.contact.has_value(), placement.contact.has_value());
    EXPECT_FALSE(episode.slowed);
  }
}

// A tool that comes near at full speed when the square appears could not be stopped by anything.
TEST_F(ClosedLoopEpisodeTest, BeginsWhereAGuardHasChangedNothing) {
  size_t earlier = 0;
  for (size_t i = 0; i < placements_.size(); ++i) {
    const Time begin = driven_.cycles[driven_.cycleAt(placed_[i].begin)].time;
    ASSERT_LE(placements_[i].begin, begin);
    earlier += placements_[i].begin < begin ? 1 : 0;
  }
  EXPECT_LT(earlier, placements_.size() / 2);
  ObstaclePlacement ahead = placed_[0];
  const size_t cycle = driven_.cycleAt(ahead.begin);
  const Vector3d v_W = driven_.cycles[cycle].command_W.v_W;
  const Vector3d tip_W = driven_.cycles[cycle].robot.pose().translation();
  ahead.obstacle = squareAt(tip_W + 0.02 * v_W.normalized(), v_W.normalized(), 0.1);
  const auto begin = beginOf(driven_, ahead, setup_);
  EXPECT_TRUE(!begin || *begin < driven_.cycles[cycle].time);
}

}  // namespace
}  // namespace sweep_guard_evaluation
