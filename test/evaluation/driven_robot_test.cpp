#include "evaluation/driven_robot.h"

#include <gtest/gtest.h>

#include "evaluation/motions.h"

namespace sweep_guard_evaluation {
namespace {

constexpr RobotOptions kFastRobot = {10.0, 100.0, 1e4, 1e5};

TEST(DrivenRobotTest, FollowsTheHandLateAndAtItsSpeed) {
  const RecordedMotion motion(straightMotion(0.1, milliseconds(20), seconds(2)));
  const DrivenRobot driven = drive(motion, kFastRobot);
  EXPECT_EQ(driven.cycles.size(), 200U);
  EXPECT_EQ(driven.path.size(), 2001U);
  EXPECT_NEAR(driven.path.back().X_WT.translation().x(), 0.2 - 0.1 * 0.05, 1e-4);
  EXPECT_NEAR(driven.cycles.back().command_W.v_W.x(), 0.1, 1e-9);
}

TEST(DrivenRobotTest, BeginsAtRestAfterAGapWhichIsLeftOut) {
  std::vector<StampedPose> poses = straightMotion(0.1, milliseconds(20), seconds(1));
  for (StampedPose pose : straightMotion(0.1, milliseconds(20), seconds(1))) {
    pose.stamp += seconds(5);
    pose.X_WT.translation().y() = 1.0;
    poses.push_back(pose);
  }
  const DrivenRobot driven = drive(RecordedMotion(poses), kFastRobot);
  ASSERT_EQ(driven.cycles.size(), 200U);
  const size_t after = driven.cycleAt(Time(seconds(3)));
  ASSERT_EQ(after, 100U);
  EXPECT_EQ(driven.cycles[after].time, Time(seconds(5)));
  EXPECT_EQ(driven.cycles[after].robot.pose().translation(), Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(driven.cycles[after].robot.velocity_W().v_W, Eigen::Vector3d::Zero());
}

TEST(DrivenRobotTest, CommandsAreWithinTheLimitsOfTheRobot) {
  const RobotOptions limits{0.1, 0.2, 0.5, 1.0};
  const DrivenRobot driven = drive(RecordedMotion(winding()), limits);
  sweep_guard_core::Twist last_W;
  double fastest = 0.0;
  for (const DrivenRobot::Cycle& cycle : driven.cycles) {
    fastest = std::max(fastest, cycle.command_W.v_W.norm());
    ASSERT_LE(cycle.command_W.v_W.norm(), limits.max_speed + 1e-12);
    ASSERT_LE(cycle.command_W.w_W.norm(), limits.max_turn_rate + 1e-12);
    ASSERT_LE((cycle.command_W.v_W - last_W.v_W).norm(), 0.01 * limits.max_acceleration + 1e-12);
    ASSERT_LE((cycle.command_W.w_W - last_W.w_W).norm(), 0.01 * limits.max_turn_acceleration + 1e-12);
    last_W = cycle.command_W;
  }
  EXPECT_NEAR(fastest, limits.max_speed, 1e-9);
}

TEST(DrivenRobotTest, WhatARecordingGoesToFollowsItAtItsStamps) {
  const sweep_guard_recording::Recording hand{"hand", straightMotion(3.0, milliseconds(20), seconds(2))};
  const auto robot = followed(hand, {});
  EXPECT_EQ(robot.name, "hand");
  ASSERT_EQ(robot.commands.size(), hand.poses.size());
  ASSERT_EQ(robot.poses.size(), hand.poses.size());
  EXPECT_EQ(robot.poses.back().stamp, hand.poses.back().stamp);
  EXPECT_NEAR(robot.poses.back().X_WT.translation().x(), hand.poses.back().X_WT.translation().x() - 3.0 * 0.05, 2e-3);
}

}  // namespace
}  // namespace sweep_guard_evaluation
