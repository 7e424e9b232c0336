#include "evaluation/guard_findings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/motions.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::TriangleMesh;
using sweep_guard_core::WarningLevel;
using sweep_guard_recording::LevelTrace;

SquareObstacle sheet(double x, double y, double half_side) {
  SquareObstacle obstacle;
  obstacle.half_side = half_side;
  obstacle.X_WS.linear() = straightMotion(0.0, seconds(1), seconds(0)).front().X_WT.linear();
  obstacle.X_WS.translation() << x, y, 0.0;
  return obstacle;
}

/// Along x with a sway, and with a second without poses.
std::vector<StampedPose> swaying() {
  std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(40), seconds(14));
  for (size_t i = 0; i < poses.size(); ++i) {
    poses[i].X_WT.translation().y() = 0.05 * std::sin(0.3 * static_cast<double>(i));
  }
  poses.erase(poses.begin() + 230, poses.begin() + 255);
  return poses;
}

void expectEqual(const LevelTrace& a, const LevelTrace& b) {
  for (const WarningLevel level : {WarningLevel::kConsidered, WarningLevel::kReflex, WarningLevel::kContact}) {
    const auto alarms_a = a.alarms(level);
    const auto alarms_b = b.alarms(level);
    ASSERT_EQ(alarms_a.size(), alarms_b.size());
    for (size_t i = 0; i < alarms_a.size(); ++i) {
      EXPECT_EQ(alarms_a[i].begin, alarms_b[i].begin);
      EXPECT_EQ(alarms_a[i].end, alarms_b[i].end);
    }
  }
}

// What is kept of the sweeps is all that the limits are compared with, and nothing that is passed over warns.
TEST(GuardFindingsTest, GiveTheLevelsOfAMonitorThatSeesEverySweepForEveryThreshold) {
  const std::vector<StampedPose> poses = swaying();
  GuardSimulationOptions options;
  options.min_probabilities = {0.01, 0.1, 0.3, 1.0};
  std::vector<ObstaclePlacement> placements;
  std::vector<TriangleMesh> objects;
  for (const SquareObstacle& obstacle : {sheet(0.411, 0.0, 0.05), sheet(0.613, 0.12, 0.1), sheet(0.951, 0.15, 0.05),
                                         sheet(0.51, 0.3, 0.1), sheet(0.921, -0.1, 0.07), sheet(3.0, 0.0, 0.1)}) {
    placements.push_back({obstacle, poses.front().stamp, poses.back().stamp, std::nullopt});
    objects.push_back(meshOf(obstacle));
  }
  const auto expected = simulateGuard(poses, placements, options, [](size_t) {});
  const GuardFindings findings = findContacts(poses, objects, options, [](size_t) {});
  size_t alarms = 0;
  for (size_t threshold = 0; threshold < options.min_probabilities.size(); ++threshold) {
    sweep_guard_core::WarningLimits limits = options.limits;
    limits.thresholds = sweep_guard_core::WarningThresholds::ofMinProbability(options.min_probabilities[threshold]);
    for (size_t object = 0; object < objects.size(); ++object) {
      const LevelTrace levels = levelsOf(findings, object, limits);
      expectEqual(levels, expected[threshold][object]);
      alarms += levels.alarms(WarningLevel::kConsidered).size();
    }
  }
  EXPECT_GT(alarms, 10U);
}

TEST(GuardFindingsTest, AreNoneFarAwayAndAContactIsFound) {
  const std::vector<TriangleMesh> objects = {meshOf(sheet(9.0, 0.0, 0.1)), meshOf(sheet(0.5, 0.0, 0.1))};
  const GuardFindings findings = findContacts(swaying(), objects, {}, [](size_t) {});
  EXPECT_TRUE(findings.objects[0].poses.empty());
  const auto contact = [](const ObjectFindings::AtPose& found) { return found.contact; };
  const auto& poses = findings.objects[1].poses;
  const auto first = std::find_if(poses.begin(), poses.end(), contact);
  ASSERT_NE(first, poses.end());
  EXPECT_NEAR(sweep_guard_core::toSeconds(findings.stamps[first->pose].time_since_epoch()), 5.0, 0.041);
}

// 1 m from pose to pose, and nothing within reach before.
TEST(GuardFindingsTest, KnowWhereTheToolWasBeforeAnythingWasNear) {
  const auto findings = findContacts(straightMotion(5.0, milliseconds(200), seconds(1)), {meshOf(sheet(2.5, 0.0, 0.1))},
                                     {}, [](size_t) {});
  const auto& poses = findings.objects[0].poses;
  EXPECT_TRUE(std::any_of(poses.begin(), poses.end(), [](const auto& found) { return found.contact; }));
}

TEST(GuardFindingsTest, ReportTheirProgress) {
  size_t done = 0;
  findContacts(swaying(), {}, {}, [&](size_t count) { done += count; });
  EXPECT_EQ(done, swaying().size());
}

}  // namespace
}  // namespace sweep_guard_evaluation
