#include "sweep_guard/geometry/motion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/round_tool.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

// Points a millisecond apart, along an axis.
Path pathAlong(const std::vector<double>& x) {
  Path path;
  for (const double place : x) path.push_back({static_cast<std::int64_t>(path.size()) * 1ms, along(place), 0.0});
  return path;
}

size_t lastOf(const Path& path, size_t first, double max_deviation) {
  return endOfMergedMotion(path, first, path.size() - 1, /*tool_radius=*/0.1, max_deviation, /*max_rotation=*/0.175);
}

TEST(MergedMotionTest, OfASteadyMotionHasNoDeviation) {
  const Motion motion = mergedMotion(pathAlong({0, 1, 2, 3, 4}), 1, 4, 0.1);
  EXPECT_EQ(motion.X_MT_start.translation().x(), 1.0);
  EXPECT_EQ(motion.X_MT_end.translation().x(), 4.0);
  EXPECT_NEAR(motion.deviation_bound, 0.0, 1e-12);
}

TEST(MergedMotionTest, DeviatesWhereThePathIsAside) {
  Path path = pathAlong({0, 1, 2});
  path[1].X_MT = placedAt(1, 0.25, 0);
  EXPECT_NEAR(mergedMotion(path, 0, 2, 0.1).deviation_bound, 0.25, 1e-12);
}

// Otherwise a time of impact on the merged motion would be late.
TEST(MergedMotionTest, DeviatesWhereThePathIsAhead) {
  EXPECT_NEAR(mergedMotion(pathAlong({0, 1.5, 2}), 0, 2, 0.1).deviation_bound, 0.5, 1e-12);
}

TEST(MergedMotionTest, DeviatesByTheArcsOfThePath) {
  Path path = pathAlong({0, 1, 2});
  path[2].deviation_bound = 0.125;
  EXPECT_NEAR(mergedMotion(path, 0, 2, 0.1).deviation_bound, 0.125, 1e-12);
}

TEST(MergedMotionTest, BoundsAPathWithoutDuration) {
  Path path = pathAlong({0, 0.5, 2});
  for (PathPoint& waypoint : path) waypoint.time = 1ms;
  EXPECT_NEAR(mergedMotion(path, 0, 2, 0.1).deviation_bound, 0.5, 1e-12);
}

// A path on whose segments tool and frame both move and turn, with samples at 20 times of each segment.
struct RandomPath {
  Path path_M;
  std::vector<std::pair<Duration, Eigen::Isometry3d>> poses_M;

  RandomPath(Random& random, const ConvexShape& tool) {
    RelativeMotion segment{randomMotion(random, tool, 3.0 * random.direction(), /*max_angle=*/0.3),
                           randomMotion(random, tool, 3.0 * random.direction(), /*max_angle=*/0.3)};
    if (random.chance(0.5)) segment.frame_W.X_MT_end = segment.frame_W.X_MT_start;
    const auto pose_M = [&](double f) -> Eigen::Isometry3d {
      return segment.frame_W.at(f).inverse() * segment.tool_W.at(f);
    };
    Duration time = 5ms;
    path_M.push_back({time, pose_M(0.0), 0.0});
    for (int i = 0; i < 6; ++i) {
      const Duration takes = random.below(4) * 1ms;
      for (int step = 0; step <= 20; ++step) poses_M.emplace_back(time + takes * step / 20, pose_M(step / 20.0));
      time += takes;
      path_M.push_back({time, pose_M(1.0), chordError(segment, tool.boundingRadius())});
      for (Motion* motion : {&segment.tool_W, &segment.frame_W}) {
        motion->X_MT_start = motion->X_MT_end;
        motion->X_MT_end.translation() += tool.boundingRadius() * random.uniform(0.0, 0.5) * random.direction();
        motion->X_MT_end.linear() = random.turn(random.uniform(0.0, 0.3)) * motion->X_MT_start.linear();
      }
    }
  }
};

// Compares tool points on the path with those on the merged motion at the same time, with and without its rotation.
TEST(MergedMotionTest, BoundsTheDeviationOfEveryToolPoint) {
  Random random(/*seed=*/5);
  double closest = 0.0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("path " + std::to_string(i));
    const ConvexShape tool = randomTool(random, 1.0);
    const auto [path_M, poses_M] = RandomPath(random, tool);
    const size_t last = 2 + static_cast<size_t>(random.below(5));
    const Motion motion_M = mergedMotion(path_M, 0, last, tool.boundingRadius());
    const double time = toSeconds(path_M[last].time - path_M[0].time);
    if (time == 0.0) continue;
    for (size_t k = 0; k < last * 21; ++k) {
      const double f = toSeconds(poses_M[k].first - path_M[0].time) / time;
      for (const Eigen::Vector3d& p_T : roundToolPoints_T(tool, 8)) {
        const Eigen::Vector3d p_M = poses_M[k].second * p_T;
        const Eigen::Vector3d straight_M = (1.0 - f) * (motion_M.X_MT_start * p_T) + f * (motion_M.X_MT_end * p_T);
        ASSERT_LE((p_M - straight_M).norm(), motion_M.deviation_bound + 1e-12) << "pose " << k;
        ASSERT_LE((p_M - motion_M.at(f) * p_T).norm(), motion_M.deviation_bound + 1e-12) << "pose " << k;
        closest = std::max(closest, (p_M - straight_M).norm() / motion_M.deviation_bound);
      }
    }
  }
  EXPECT_GT(closest, 0.9);
}

TEST(EndOfMergedMotionTest, IsTheEndOfASteadyMotion) {
  for (size_t count = 2; count < 40; ++count) {
    std::vector<double> x(count);
    for (size_t i = 0; i < count; ++i) x[i] = 0.01 * static_cast<double>(i);
    EXPECT_EQ(lastOf(pathAlong(x), 0, 1e-9), count - 1);
    EXPECT_EQ(lastOf(pathAlong(x), count - 2, 1e-9), count - 1);
  }
}

// Rest, there and back, rest: from any start, the merged motion ends at the next corner of the flick.
TEST(EndOfMergedMotionTest, StopsAtAFlick) {
  for (size_t rest = 2; rest < 40; ++rest) {
    std::vector<double> x(2 * rest + 1, 0.0);
    x[rest] = 1.0;
    EXPECT_EQ(lastOf(pathAlong(x), 0, 0.01), rest - 1);
    EXPECT_EQ(lastOf(pathAlong(x), rest - 1, 0.01), rest);
    EXPECT_EQ(lastOf(pathAlong(x), rest, 0.01), rest + 1);
    EXPECT_EQ(lastOf(pathAlong(x), rest + 1, 0.01), 2 * rest);
  }
}

TEST(EndOfMergedMotionTest, TurnsByNoMoreThanItMay) {
  Path path;
  for (int i = 0; i < 20; ++i)
    path.push_back({i * 1ms, Eigen::Isometry3d(Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitZ()))});
  const size_t last = lastOf(path, 0, /*max_deviation=*/1.0);
  EXPECT_EQ(last, 3U);
  EXPECT_LE((Motion{path[0].X_MT, path[last].X_MT}.angle()), 0.175);
}

}  // namespace
}  // namespace sweep_guard_core
