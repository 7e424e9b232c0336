// motion_guard before the joints of an arm, in each type of command, with a guard that the test plays. On the wall clock:
// silence has a limit.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64MultiArray.h>
#include <sweep_guard/MotionStatus.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "drop_in_fixture.h"
#include "message_md5.h"
#include "refusal.h"
#include "ros/child_process.h"
#include "ros/input/joint_jog.h"

namespace sweep_guard_ros {
namespace {

using std_msgs::Float64MultiArray;
using sweep_guard::MotionStatus;
using trajectory_msgs::JointTrajectory;

constexpr double kClose = 0.01;  // gap [m]
const std::vector<std::string> kJoints = {"shoulder", "elbow", "jaw"};

JointJog jogOf(const std::vector<std::string>& joints, const std::vector<double>& velocities) {
  JointJog message;
  message.joint_names = joints;
  message.velocities = velocities;
  return message;
}

// A command of two joints: the shoulder moves the ball down if it is > 0, the elbow, too.
JointJog jog(double shoulder, double elbow) { return jogOf({"shoulder", "elbow"}, {shoulder, elbow}); }

JointTrajectory trajectory(double shoulder, double elbow) {
  JointTrajectory message;
  message.joint_names = {"shoulder", "elbow"};
  message.points.resize(1);
  message.points[0].velocities = {shoulder, elbow};
  message.points[0].time_from_start = ros::Duration(0.01);
  return message;
}

Float64MultiArray array(double shoulder, double elbow) {
  Float64MultiArray message;
  message.data = {elbow, shoulder};
  return message;
}

std::vector<double> velocitiesOf(const JointJog& message) { return message.velocities; }
std::vector<double> velocitiesOf(const Float64MultiArray& message) { return message.data; }
std::vector<double> velocitiesOf(const JointTrajectory& message) {
  return message.points.empty() ? std::vector<double>() : message.points[0].velocities;
}

bool hasVelocitiesAlone(const JointJog& message) { return message.displacements.empty(); }
bool hasVelocitiesAlone(const Float64MultiArray& /*message*/) { return true; }
bool hasVelocitiesAlone(const JointTrajectory& message) {
  return message.points.size() == 1 && message.points[0].positions.empty();
}

// The ball is at the end of the forearm, 0.5 m before the base.
FakeLink endOfForearm() { return {"base", "fore", {0.2, 0.0, 0.0}, {0.5, 0.0, 0.0}, kJoints, {0.0, 0.0, 0.0}}; }

class JointMotionTest : public testing::Test {
 protected:
  JointMotionTest() {
    spinner_.start();
    publishJoints(kJoints);
  }
  void TearDown() override { spinner_.stop(); }

  void publishJoints(const std::vector<std::string>& names) {
    sensor_msgs::JointState state;
    state.name = names;
    state.position.assign(names.size(), 0.0);
    joint_states_.send(state);
  }

  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_{2};
  FakeGuard guard_{"/arm_guard", endOfForearm()};
  Stream<sensor_msgs::JointState> joint_states_{"/joint_states"};
};

template <typename Msg>
struct Driven {
  explicit Driven(const std::string& name)
      : commands(name + "/command"), sent(name + "/guarded_command"), statuses(name + "/motion_guard/status") {}

  void awaitWhole(const Msg& command) {
    commands.send(command);
    sent.await("the whole command", [&](const Msg& now) { return velocitiesOf(now) == velocitiesOf(command); });
  }
  void awaitRefusal(const Msg& command, const std::string& why) {
    commands.send(command);
    const MotionStatus status = statuses.await(why, [](const auto& now) { return now.code == MotionStatus::INVALID; });
    EXPECT_TRUE(has(status.text, why)) << status.text;
    sent.await("zero, and nothing of what was refused", [](const Msg& now) {
      return velocitiesOf(now) == std::vector<double>{0.0, 0.0} && hasVelocitiesAlone(now);
    });
  }
  void awaitCause(const std::string& cause) {
    const MotionStatus status = statuses.await(cause, [&](const auto& now) { return now.cause == cause; });
    EXPECT_EQ(status.code, MotionStatus::HALT_FOR_COLLISION);
    sent.await("standstill", [](const Msg& now) {
      const auto velocities = velocitiesOf(now);
      return std::all_of(velocities.begin(), velocities.end(), [](double each) { return each == 0.0; });
    });
  }

  Stream<Msg> commands;
  Listener<Msg> sent;
  Listener<MotionStatus> statuses;
};

template <typename Msg>
void expectAScaledWayDownAndAWholeWayUp(FakeGuard& guard, const std::string& name, Msg (*make)(double, double)) {
  Driven<Msg> driven(name);
  driven.awaitWhole(make(0.4, -0.1));
  guard.setGap(kClose);
  const std::vector<double> wanted = velocitiesOf(make(0.4, -0.1));
  const Msg limited = driven.sent.await("a part of the command", [&](const Msg& now) {
    const auto velocities = velocitiesOf(now);
    return velocities.size() == 2 && velocities[0] != wanted[0] && velocities[0] != 0.0;
  });
  const std::vector<double> sent = velocitiesOf(limited);
  EXPECT_LT(std::abs(sent[0]), std::abs(wanted[0]));
  EXPECT_NEAR(sent[0] / sent[1], wanted[0] / wanted[1], 1e-12) << "the path does not bend";
  const MotionStatus status =
      driven.statuses.await("slow", [](const auto& now) { return now.code == MotionStatus::DECELERATE_FOR_COLLISION; });
  EXPECT_EQ(status.tool_link, "fore");
  EXPECT_EQ(status.mesh_id, "table");
  driven.awaitWhole(make(-0.4, 0.1));
}

TEST_F(JointMotionTest, JogsAreScaledAsAWholeAndARetreatIsPassedOn) {
  expectAScaledWayDownAndAWholeWayUp(guard_, "jog", jog);
}

TEST_F(JointMotionTest, TrajectoriesOfOnePointAreScaledAsAWholeAndARetreatIsPassedOn) {
  expectAScaledWayDownAndAWholeWayUp(guard_, "trajectory", trajectory);
}

TEST_F(JointMotionTest, ArraysAreScaledAsAWholeAndARetreatIsPassedOn) {
  expectAScaledWayDownAndAWholeWayUp(guard_, "array", array);
}

TEST_F(JointMotionTest, WhatIsNoVelocityOfAKnownJointIsRefusedInWords) {
  Driven<JointJog> driven("jog");
  driven.awaitWhole(jog(0.1, 0.1));
  driven.awaitRefusal(jogOf({"shoulder", "wrist"}, {0.1, 0.1}), "joint 'wrist' is none of the robot's below 'base'");
  driven.awaitWhole(jog(0.1, 0.1));
  driven.awaitRefusal(jogOf({"shoulder", "other_jaw"}, {0.1, 0.1}), "mimics another one");
  driven.awaitRefusal(jogOf({"shoulder", "shoulder"}, {0.1, 0.1}), "joint 'shoulder' is named twice");
  driven.awaitRefusal(jog(0.1, std::nan("")), "commanded joint velocities refused");
  driven.awaitRefusal(jogOf({"shoulder", "elbow"}, {0.1}), "there are 1 velocities for 2 joints");
  driven.awaitWhole(jog(0.1, 0.1));
  JointJog command = jog(0.1, 0.1);
  command.displacements = {0.1, 0.1};
  driven.awaitRefusal(command, "displacements are not limited");
}

// The zero of a refusal is for the joints that move.
TEST_F(JointMotionTest, ARefusedCommandOfOtherJointsStopsThoseOfTheCommandBefore) {
  Driven<JointJog> driven("jog");
  for (const double refused : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    driven.awaitWhole(jog(0.1, 0.1));
    driven.awaitRefusal(jogOf({"elbow"}, {refused}), "commanded joint velocities refused");
  }
  driven.awaitWhole(jog(0.1, 0.1));
  driven.awaitRefusal(JointJog(), "it names no joint");
}

TEST_F(JointMotionTest, AJointThatIsNamedNoMoreIsSentZeroFirst) {
  Driven<JointJog> driven("jog");
  std::atomic<bool> heard = false;
  std::atomic<bool> zero = false;
  const auto hear = [&](const JointJog::ConstPtr& sent) {
    heard = true;
    zero = zero || sent->velocities == std::vector<double>{0.0, 0.0};
  };
  const ros::Subscriber all = node_.subscribe<JointJog>("jog/guarded_command", 1000, hear);
  driven.commands.send(jog(0.1, 0.1));
  driven.sent.await("two joints", [&](const JointJog& now) { return heard && now.velocities.size() == 2; });
  zero = false;
  driven.awaitWhole(jogOf({"elbow"}, {0.2}));
  driven.sent.await("zero of both", [&](const JointJog& /*now*/) { return zero.load(); });
}

TEST_F(JointMotionTest, ATrajectoryThatBeginsLaterIsRefusedAndTheZeroOfOneThatBeganAtOnceDoesSo) {
  Driven<JointTrajectory> driven("trajectory");
  driven.commands.send(trajectory(0.1, 0.1), /*stamped=*/false);
  driven.sent.await("the whole command", [](const auto& now) { return velocitiesOf(now)[0] == 0.1; });
  JointTrajectory command = trajectory(0.1, 0.1);
  command.header.stamp = ros::Time::now() + ros::Duration(1e4);
  driven.commands.send(command, /*stamped=*/false);
  driven.statuses.await("refused", [](const auto& now) { return has(now.text, "stamp lies in the future"); });
  driven.sent.await("zero that begins at once", [](const JointTrajectory& now) {
    return velocitiesOf(now) == std::vector<double>{0.0, 0.0} && now.header.stamp == ros::Time();
  });
}

TEST_F(JointMotionTest, AJointThatTheGuardDoesNotKnowIsRefused) {
  Driven<JointJog> driven("jog");
  driven.awaitWhole(jog(0.1, 0.1));
  driven.awaitRefusal(jogOf({"shoulder", "pan"}, {0.1, 0.1}), "joint 'pan'");
  driven.awaitWhole(jogOf({"shoulder", "pan"}, {0.1, 0.0}));
}

TEST_F(JointMotionTest, PositionsAndLongerTrajectoriesAreRefusedInWords) {
  Driven<JointTrajectory> driven("trajectory");
  driven.awaitWhole(trajectory(0.1, 0.1));
  JointTrajectory command = trajectory(0.1, 0.1);
  command.points[0].positions = {0.1, 0.1};
  driven.awaitRefusal(command, "publish_joint_positions");
  driven.awaitWhole(trajectory(0.1, 0.1));
  command = trajectory(0.1, 0.1);
  command.points.resize(2);
  driven.awaitRefusal(command, "a trajectory of 2 points");
}

TEST_F(JointMotionTest, AnArrayThatHasNotOneVelocityForEachJointIsRefusedInWords) {
  Driven<Float64MultiArray> driven("array");
  driven.awaitWhole(array(0.1, 0.1));
  Float64MultiArray command;
  command.data = {0.1};
  driven.awaitRefusal(command, "there are 1 velocities for 2 joints");
}

TEST_F(JointMotionTest, StopsWhenTheJointsAreSilentOrThoseOfAnotherRobot) {
  Driven<JointJog> driven("jog");
  driven.awaitWhole(jog(0.1, 0.1));
  publishJoints({"joint_a1", "joint_a2"});
  driven.awaitCause("no new joint positions");
  publishJoints(kJoints);
  driven.awaitWhole(jog(0.1, 0.1));
  guard_.setJoints({"joint_a1"});
  driven.awaitCause("the separating planes are not of this robot: do its joints move the guard's tool?");
  guard_.setJoints({});
  driven.awaitCause("the separating planes are not of this robot: do its joints move the guard's tool?");
}

TEST_F(JointMotionTest, BadPositionsAreRefusedInWords) {
  Driven<JointJog> driven("jog");
  driven.awaitWhole(jog(0.1, 0.1));
  Listener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const auto awaitLine = [&](const std::string& why) {
    diagnostics.await(why, [&](const diagnostic_msgs::DiagnosticArray& now) {
      return std::any_of(now.status.begin(), now.status.end(), [&](const auto& line) {
        return line.name == "jog/motion_guard: joints" &&
               std::any_of(line.values.begin(), line.values.end(),
                           [&](const auto& each) { return each.value.find(why) != std::string::npos; });
      });
    });
  };
  sensor_msgs::JointState state;
  state.name = kJoints;
  state.position = {0.0, std::nan(""), 0.0};
  joint_states_.send(state);
  driven.awaitCause("no new joint positions");
  awaitLine("joint 'elbow': its position must be finite");
  state.position = {0.0};
  joint_states_.send(state);
  awaitLine("and has 1 positions");
}

TEST_F(JointMotionTest, ARobotWithoutADescriptionEndsTheNodeWithOneLine) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("motion_guard_node");
  ChildProcess node({program.string(), "__name:=bare", "_command_type:=joint_jog", "_tool/robot_description:=none"});
  EXPECT_EQ(node.wait(), 2);
  EXPECT_TRUE(has(node.output(), "there is no robot description in the parameter 'none'"));
}

TEST(JointJogTest, HasTheMd5OfTheOriginalDefinition) {
  const std::string definition = md5<std_msgs::Header>() +
                                 " header\nstring[] joint_names\nfloat64[] displacements\nfloat64[] velocities\n"
                                 "float64 duration";
  EXPECT_EQ(md5Of(definition), md5<JointJog>());
  EXPECT_STREQ(ros::message_traits::DataType<JointJog>::value(), "control_msgs/JointJog");
}

}  // namespace
}  // namespace sweep_guard_ros
