#include "evaluation/simulate_guard.h"

#include <gtest/gtest.h>

#include "evaluation/alarm_statistics.h"
#include "evaluation/first_contact.h"
#include "evaluation/motions.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::WarningLevel;
using sweep_guard_recording::LevelTrace;
using sweep_guard_recording::TimeInterval;

class SimulateGuardTest : public testing::Test {
 protected:
  static SquareObstacle wallAt(double x, double y = 0.0) {
    SquareObstacle obstacle;
    obstacle.X_WS.linear() = straightMotion(0.0, seconds(1), seconds(0)).front().X_WT.linear();
    obstacle.X_WS.translation() << x, y, 0.0;
    return obstacle;
  }

  /// The episode begins 4 s before the contact; without contact it lasts for the whole motion.
  ObstaclePlacement place(const SquareObstacle& obstacle) const {
    const RecordedMotion motion(poses_);
    const auto contact = firstContact(motion, options_.tool, obstacle, Time(seconds(0)), poses_.back().stamp);
    if (!contact) return {obstacle, Time(seconds(1)), poses_.back().stamp, std::nullopt};
    return {obstacle, *contact - seconds(4), *contact, contact};
  }

  std::vector<LevelTrace> simulateAt(double min_probability, const std::vector<ObstaclePlacement>& placements) {
    options_.min_probabilities = {min_probability};
    options_.guard.predictor.predictor = "constant_velocity";
    return simulateGuard(poses_, placements, options_, [](size_t) {}).front();
  }

  std::vector<StampedPose> poses_ = straightMotion(0.1, milliseconds(20), seconds(12));
  GuardSimulationOptions options_;
};

// A motion that is predicted without error warns as early as the intervals reach, and not for a wall beside.
TEST_F(SimulateGuardTest, AConstantVelocityIsWarnedOfInTimeAndAWallBesideIsNot) {
  const std::vector<ObstaclePlacement> placements = {place(wallAt(0.5)), place(wallAt(0.7)), place(wallAt(0.6, 0.2))};
  const auto levels = simulateAt(1.0, placements);
  for (size_t i = 0; i < 2; ++i) {
    const Time contact = placements[i].contact.value();
    EXPECT_NEAR(sweep_guard_core::toSeconds(leadOf(contact, levels[i], alarmRules()[0]).value()), 0.1, 0.05);
    EXPECT_NEAR(sweep_guard_core::toSeconds(leadOf(contact, levels[i], alarmRules()[1]).value()), 1.0, 0.15);
    EXPECT_GE(leadOf(contact, levels[i], alarmRules()[0]), milliseconds(100));
    EXPECT_GE(leadOf(contact, levels[i], alarmRules()[1]), seconds(1));
  }
  EXPECT_TRUE(levels[2].alarms(WarningLevel::kConsidered).empty());
  EXPECT_EQ(placements[2].contact, std::nullopt);
}

TEST_F(SimulateGuardTest, EndsWithTheContactThatTheGuardFinds) {
  const auto levels = simulateAt(0.1, {place(wallAt(0.5))});
  const auto contact = levels[0].alarms(WarningLevel::kContact);
  ASSERT_EQ(contact.size(), 1U);
  EXPECT_NEAR(sweep_guard_core::toSeconds(contact[0].begin.time_since_epoch()), 5.0, 0.021);
}

TEST_F(SimulateGuardTest, ComputesAWarningForEveryThreshold) {
  for (size_t i = 0; i < poses_.size(); ++i) {
    poses_[i].X_WT.translation().y() = 0.05 * std::sin(0.2 * static_cast<double>(i));
  }
  options_.min_probabilities = {0.01, 1.0};
  options_.guard.predictor.predictor = "constant_velocity";
  const auto by_threshold = simulateGuard(poses_, {place(wallAt(0.6, 0.2))}, options_, [](size_t) {});
  EXPECT_GT(by_threshold[0][0].alarms(WarningLevel::kConsidered).size(), 0U);
  const auto seconds_of = [](const LevelTrace& levels) {
    sweep_guard_core::Duration sum{0};
    for (const TimeInterval& alarm : levels.alarms(WarningLevel::kConsidered)) sum += alarm.end - alarm.begin;
    return sum;
  };
  EXPECT_GT(seconds_of(by_threshold[0][0]), seconds_of(by_threshold[1][0]));
}

// Placements share a guard, and each has its own warning.
TEST_F(SimulateGuardTest, OnePlacementDoesNotDisturbAnother) {
  const ObstaclePlacement first = place(wallAt(0.5));
  const ObstaclePlacement second = place(wallAt(0.52, 0.05));
  const auto together = simulateAt(0.1, {first, second});
  const auto alone = simulateAt(0.1, {second});
  const auto a = together[1].alarms(WarningLevel::kConsidered);
  const auto b = alone[0].alarms(WarningLevel::kConsidered);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].begin, b[i].begin);
    EXPECT_EQ(a[i].end, b[i].end);
  }
}

TEST_F(SimulateGuardTest, ReportsItsProgress) {
  size_t done = 0;
  options_.min_probabilities = {0.1};
  simulateGuard(poses_, {}, options_, [&](size_t count) { done += count; });
  EXPECT_EQ(done, poses_.size());
}

}  // namespace
}  // namespace sweep_guard_evaluation
