#include "evaluation/simulated_robot.h"

#include <gtest/gtest.h>

namespace sweep_guard_evaluation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using sweep_guard_core::Twist;

Twist along(double x) { return {{x, 0.0, 0.0}, Vector3d::Zero()}; }

RobotOptions delayedBy(milliseconds dead_time, milliseconds lag) {
  RobotOptions options;
  options.dead_time = dead_time;
  options.lag = lag;
  return options;
}

void runFor(SimulatedRobot& robot, int ms) {
  for (int i = 0; i < ms; ++i) robot.step();
}

TEST(SimulatedRobotTest, RestsForTheDeadTime) {
  SimulatedRobot robot(Isometry3d::Identity(), delayedBy(milliseconds(20), milliseconds(0)));
  robot.send(along(1.0));
  runFor(robot, 20);
  EXPECT_EQ(robot.pose().translation().x(), 0.0);
  runFor(robot, 10);
  EXPECT_NEAR(robot.pose().translation().x(), 0.01, 1e-12);
}

TEST(SimulatedRobotTest, HasMadeUpForAllButOneEthAfterItsLag) {
  SimulatedRobot robot(Isometry3d::Identity(), delayedBy(milliseconds(0), milliseconds(30)));
  robot.send(along(1.0));
  runFor(robot, 30);
  EXPECT_NEAR(robot.velocity_W().v_W.x(), 1.0 - std::exp(-1.0), 1e-12);
}

TEST(SimulatedRobotTest, TurnsAboutTheOriginOfTheTool) {
  Isometry3d X_WT = Isometry3d::Identity();
  X_WT.translation() = Vector3d(1.0, 2.0, 3.0);
  SimulatedRobot robot(X_WT, delayedBy(milliseconds(0), milliseconds(0)));
  robot.send({Vector3d::Zero(), {0.0, 0.0, 2.0}});
  runFor(robot, 100);
  EXPECT_EQ(robot.pose().translation(), X_WT.translation());
  EXPECT_TRUE(robot.pose().linear().isApprox(Eigen::AngleAxisd(0.2, Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(ClippedTest, ChangesNothingWithinTheLimits) {
  const Twist last_W = along(0.1);
  const Twist wanted_W{{0.105, 0.0, 0.0}, {0.0, 0.05, 0.0}};
  const Twist command_W = clipped(wanted_W, last_W, {0.5, 1.0, 2.0, 10.0}, 0.01);
  EXPECT_TRUE(command_W.v_W.isApprox(wanted_W.v_W, 1e-12));
  EXPECT_TRUE(command_W.w_W.isApprox(wanted_W.w_W, 1e-12));
}

TEST(ClippedTest, IsWithinSpeedAndAcceleration) {
  const Twist first_W = clipped({{3.0, 4.0, 0.0}, {0.0, 0.0, -9.0}}, {}, {0.5, 1.0, 2.0, 10.0}, 0.01);
  EXPECT_TRUE(first_W.v_W.isApprox(Vector3d(0.012, 0.016, 0.0), 1e-12));
  EXPECT_TRUE(first_W.w_W.isApprox(Vector3d(0.0, 0.0, -0.1), 1e-12));
  Twist command_W;
  for (int i = 0; i < 100; ++i)
    command_W = clipped({{3.0, 4.0, 0.0}, {0.0, 0.0, -9.0}}, command_W, {0.5, 1.0, 2.0, 10.0}, 0.01);
  EXPECT_TRUE(command_W.v_W.isApprox(Vector3d(0.3, 0.4, 0.0), 1e-12));
  EXPECT_TRUE(command_W.w_W.isApprox(Vector3d(0.0, 0.0, -1.0), 1e-12));
}

}  // namespace
}  // namespace sweep_guard_evaluation
