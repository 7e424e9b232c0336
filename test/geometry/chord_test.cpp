#include "sweep_guard/geometry/chord.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/round_tool.h"
#include "scenes.h"

namespace sweep_guard {
namespace {

using namespace std::chrono_literals;

Eigen::Isometry3d at(double x, double y = 0.0) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0)); }

// A millisecond apart, along an axis.
Waypoints wayAlong(const std::vector<double>& x) {
  Waypoints way;
  for (const double place : x) way.push_back({static_cast<std::int64_t>(way.size()) * 1ms, at(place), 0.0});
  return way;
}

size_t lastOf(const Waypoints& way, size_t first, double max_bulge) {
  return lastOfChord(way, first, way.size() - 1, /*tool_extent=*/0.1, {max_bulge, /*max_rotation=*/0.175});
}

TEST(ChordTest, OfASteadyMotionDoesNotBulge) {
  const Motion motion = chord(wayAlong({0, 1, 2, 3, 4}), 1, 4, 0.1);
  EXPECT_EQ(motion.X_MT_start.translation().x(), 1.0);
  EXPECT_EQ(motion.X_MT_end.translation().x(), 4.0);
  EXPECT_NEAR(motion.bulge, 0.0, 1e-12);
}

TEST(ChordTest, BulgesAsFarAsTheWayIsAside) {
  Waypoints way = wayAlong({0, 1, 2});
  way[1].X_MT = at(1, 0.25);
  EXPECT_NEAR(chord(way, 0, 2, 0.1).bulge, 0.25, 1e-12);
}

// A time of impact on the chord would be late otherwise.
TEST(ChordTest, BulgesAsFarAsTheWayIsAheadOfIt) {
  EXPECT_NEAR(chord(wayAlong({0, 1.5, 2}), 0, 2, 0.1).bulge, 0.5, 1e-12);
}

TEST(ChordTest, BulgesByTheArcsOfTheWay) {
  Waypoints way = wayAlong({0, 1, 2});
  way[2].arc = 0.125;
  EXPECT_NEAR(chord(way, 0, 2, 0.1).bulge, 0.125, 1e-12);
}

TEST(ChordTest, HoldsAWayThatTakesNoTime) {
  Waypoints way = wayAlong({0, 0.5, 2});
  for (Waypoint& waypoint : way) waypoint.time = 1ms;
  EXPECT_NEAR(chord(way, 0, 2, 0.1).bulge, 0.5, 1e-12);
}

// A way of legs on which tool and frame both go and turn, and its points at 20 times each.
struct RandomWay {
  Waypoints way_M;
  std::vector<std::pair<Duration, Eigen::Isometry3d>> poses_M;

  RandomWay(Random& random, const ConvexShape& tool) {
    RelativeMotion leg{randomMotion(random, tool, 3.0 * random.direction(), /*max_angle=*/0.3),
                       randomMotion(random, tool, 3.0 * random.direction(), /*max_angle=*/0.3)};
    if (random.chance(0.5)) leg.frame_W.X_MT_end = leg.frame_W.X_MT_start;
    const auto pose_M = [&](double f) -> Eigen::Isometry3d { return leg.frame_W.at(f).inverse() * leg.tool_W.at(f); };
    Duration time = 5ms;
    way_M.push_back({time, pose_M(0.0), 0.0});
    for (int i = 0; i < 6; ++i) {
      const Duration takes = random.below(4) * 1ms;
      for (int step = 0; step <= 20; ++step) poses_M.emplace_back(time + takes * step / 20, pose_M(step / 20.0));
      time += takes;
      way_M.push_back({time, pose_M(1.0), arc(leg, tool.extent())});
      for (Motion* motion : {&leg.tool_W, &leg.frame_W}) {
        motion->X_MT_start = motion->X_MT_end;
        motion->X_MT_end.translation() += tool.extent() * random.uniform(0.0, 0.5) * random.direction();
        motion->X_MT_end.linear() = random.turn(random.uniform(0.0, 0.3)) * motion->X_MT_start.linear();
      }
    }
  }
};

// Against the way itself: where a tool point is, and where the chord has it at that time, as a motion that turns and as
// a straight line.
TEST(ChordTest, BoundsHowFarEveryToolPointLeavesIt) {
  Random random(/*seed=*/5);
  double closest = 0.0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("way " + std::to_string(i));
    const ConvexShape tool = randomTool(random, 1.0);
    const auto [way_M, poses_M] = RandomWay(random, tool);
    const auto last = static_cast<size_t>(2 + random.below(5));
    const Motion motion_M = chord(way_M, 0, last, tool.extent());
    const double time = toSeconds(way_M[last].time - way_M[0].time);
    if (time == 0.0) continue;
    for (size_t k = 0; k < last * 21; ++k) {
      const double f = toSeconds(poses_M[k].first - way_M[0].time) / time;
      for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 8)) {
        const Eigen::Vector3d p_M = poses_M[k].second * p_T;
        const Eigen::Vector3d straight_M = (1.0 - f) * (motion_M.X_MT_start * p_T) + f * (motion_M.X_MT_end * p_T);
        ASSERT_LE((p_M - straight_M).norm(), motion_M.bulge + 1e-12) << "pose " << k;
        ASSERT_LE((p_M - motion_M.at(f) * p_T).norm(), motion_M.bulge + 1e-12) << "pose " << k;
        closest = std::max(closest, (p_M - straight_M).norm() / motion_M.bulge);
      }
    }
  }
  EXPECT_GT(closest, 0.9);
}

TEST(LastOfChordTest, IsTheEndOfASteadyMotion) {
  for (size_t count = 2; count < 40; ++count) {
    std::vector<double> x(count);
    for (size_t i = 0; i < count; ++i) x[i] = 0.01 * static_cast<double>(i);
    EXPECT_EQ(lastOf(wayAlong(x), 0, 1e-9), count - 1);
    EXPECT_EQ(lastOf(wayAlong(x), count - 2, 1e-9), count - 1);
  }
}

// Rest, there and back, rest: wherever it begins, the chord ends at the flick's next corner.
TEST(LastOfChordTest, StopsAtAFlick) {
  for (size_t rest = 2; rest < 40; ++rest) {
    std::vector<double> x(2 * rest + 1, 0.0);
    x[rest] = 1.0;
    EXPECT_EQ(lastOf(wayAlong(x), 0, 0.01), rest - 1);
    EXPECT_EQ(lastOf(wayAlong(x), rest - 1, 0.01), rest);
    EXPECT_EQ(lastOf(wayAlong(x), rest, 0.01), rest + 1);
    EXPECT_EQ(lastOf(wayAlong(x), rest + 1, 0.01), 2 * rest);
  }
}

TEST(LastOfChordTest, TurnsByNoMoreThanItMay) {
  Waypoints way;
  for (int i = 0; i < 20; ++i)
    way.push_back({i * 1ms, Eigen::Isometry3d(Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitZ()))});
  const size_t last = lastOf(way, 0, /*max_bulge=*/1.0);
  EXPECT_EQ(last, 3U);
  EXPECT_LE((Motion{way[0].X_MT, way[last].X_MT}.angle()), 0.175);
}

}  // namespace
}  // namespace sweep_guard
