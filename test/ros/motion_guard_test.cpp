// The node and the nodelet, with a guard that the test plays. One of them for each type of command.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Int8.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "refusal.h"
#include "ros/child_process.h"
#include "ros/motion/absent_guard.h"
#include "ros/motion/hold_publisher.h"
#include "ros/motion_guard_fixture.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::PoseStamped;
using geometry_msgs::Twist;
using geometry_msgs::TwistStamped;
using sweep_guard::MotionStatus;

Twist twist(double x, double y = 0.0, double turn = 0.0) {
  Twist twist;
  twist.linear.x = x;
  twist.linear.y = y;
  twist.angular.z = turn;
  return twist;
}

constexpr double kSilence = 0.5;  // [s] of the node of poses

bool isZero(const Twist& sent) { return sent == Twist(); }

class MotionGuardNodeTest : public testing::Test {
 protected:
  void SetUp() override {
    world_.change([](auto& state) { state = {}; });
  }
  void TearDown() override {
    robot_.shutdown();
    SetUp();
  }

  // A robot that does at once what is sent, unless it stands.
  void startRobot() {
    robot_ = node_.subscribe<PoseStamped>("/pose/guarded_command", 10, [this](const PoseStamped::ConstPtr& sent) {
      if (!stands_) world_.change([&](auto& state) { state.X_WT = fromMsg(sent->pose); });
    });
  }

  void command(const Twist& command) { this->command(command, twist_); }
  void command(const Twist& command, const ros::Publisher& publisher) {
    world_.change([=](auto& state) { state.command = [=](const ros::Time&) { publisher.publish(command); }; });
  }
  void commandStamped(const Twist& command, const std::string& frame = "world") {
    world_.change([=](auto& state) {
      state.command = [=](const ros::Time& now) {
        TwistStamped stamped;
        stamped.header.frame_id = frame;
        stamped.header.stamp = now;
        stamped.twist = command;
        stamped_.publish(stamped);
      };
    });
  }
  void commandPose(const Eigen::Isometry3d& X_WT, const std::string& frame = "world") {
    world_.change([=](auto& state) {
      state.command = [=](const ros::Time& now) {
        PoseStamped pose;
        pose.header.frame_id = frame;
        pose.header.stamp = now;
        pose.pose = toMsg(X_WT);
        pose_.publish(pose);
      };
    });
  }
  void place(double x) {
    world_.change([=](auto& state) { state.X_WT = Eigen::Translation3d(x, 0.0, 0.0); });
  }
  // Returns once the tool is seen there: a tool pose that is older stops it.
  void moveRobotTo(double x) {
    startRobot();
    commandPose(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)));
    guarded_poses_.await([=](const PoseStamped& sent) { return sent.pose.position.x == x; }, "the pose");
    const ros::Time seen = ros::Time::now() + ros::Duration(kSilence + 0.2);
    Inbox<MotionStatus> statuses(node_, "/pose/motion_guard/status");
    statuses.await(
        [=](const MotionStatus& next) { return next.header.stamp > seen && next.code == MotionStatus::NO_WARNING; },
        "a tool that is there");
  }
  void awaitFreeMotion() {
    command(twist(0.1));
    guarded_twists_.await([](const Twist& sent) { return sent == twist(0.1); }, "free motion");
  }
  MotionStatus awaitStatus(const std::function<bool(const MotionStatus&)>& fits, const std::string& what) {
    return statuses_.await(fits, what);
  }

  ros::NodeHandle node_;
  ros::Publisher twist_ = node_.advertise<Twist>("/twist/command", 10);
  ros::Publisher stamped_ = node_.advertise<TwistStamped>("/stamped/command", 10);
  ros::Publisher pose_ = node_.advertise<PoseStamped>("/pose/command", 10);
  ros::Publisher tip_ = node_.advertise<Twist>("/tip/command", 10);  // its commands are of the tip, along turned axes
  Inbox<Twist> guarded_tip_{node_, "/tip/guarded_command"};
  Inbox<Twist> guarded_twists_{node_, "/twist/guarded_command"};
  Inbox<TwistStamped> guarded_stamped_{node_, "/stamped/guarded_command"};
  Inbox<PoseStamped> guarded_poses_{node_, "/pose/guarded_command"};
  Inbox<MotionStatus> statuses_{node_, "/twist/motion_guard/status"};
  MotionWorld world_;
  std::atomic<bool> stands_ = false;
  ros::Subscriber robot_;
};

TEST_F(MotionGuardNodeTest, FreeMotionIsPassedOnBitForBitInEachType) {
  const Twist odd = twist(-0.1234567890123, 0.0543210987654, 0.3333333333333);
  command(odd);
  guarded_twists_.await([&](const Twist& sent) { return sent == odd; }, "the twist");
  commandStamped(odd);
  const TwistStamped sent =
      guarded_stamped_.await([&](const TwistStamped& next) { return next.twist == odd; }, "the stamped twist");
  EXPECT_EQ(sent.header.frame_id, "world");
  EXPECT_FALSE(sent.header.stamp.isZero());
  Eigen::Isometry3d goal_WT(Eigen::AngleAxisd(0.0123, Eigen::Vector3d::UnitZ()));
  goal_WT.translation() = Eigen::Vector3d(0.8012345678901, 0.0001234567, 0.0);
  commandPose(goal_WT);
  guarded_poses_.await([&](const PoseStamped& next) { return next.pose == toMsg(goal_WT); }, "the pose");
}

TEST_F(MotionGuardNodeTest, SlowsDownBeforeAPlaneAndSaysWhichOne) {
  place(0.02);
  command(twist(-0.5, 0.2));
  const Twist sent = guarded_twists_.await(
      [](const Twist& next) { return next.linear.x < 0.0 && next.linear.x > -0.3; }, "a slower twist");
  EXPECT_NEAR(sent.linear.y, 0.2, 1e-9);
  const MotionStatus status =
      awaitStatus([](const MotionStatus& next) { return next.code == MotionStatus::DECELERATE_FOR_COLLISION; }, "slow");
  EXPECT_EQ(status.mesh_id, "wall");
  EXPECT_EQ(status.triangle, 7U);
  EXPECT_EQ(status.tool_link, "needle");
  EXPECT_EQ(status.cause, "guarded");
  EXPECT_LT(status.scale, 1.0);
  EXPECT_LT(status.sent_speed, status.commanded_speed);
  EXPECT_LE(status.gap, 0.02);
  EXPECT_GE(status.planes_age, 0.0);
  EXPECT_TRUE(has(status.text, "slowed before 'wall', triangle 7"));
}

TEST_F(MotionGuardNodeTest, ARetreatIsPassedOnAsItIs) {
  place(0.0005);
  command(twist(-0.1));
  guarded_twists_.await(isZero, "zero before the wall");
  command(twist(0.37));
  guarded_twists_.await([](const Twist& sent) { return sent == twist(0.37); }, "the retreat");
}

TEST_F(MotionGuardNodeTest, StopsWhenTheGuardDoesNotKnowOrIsSilent) {
  const std::vector<std::pair<std::string, std::function<void(MotionWorld::State&)>>> cases = {
      {"the guard's level is UNKNOWN", [](auto& state) { state.level = sweep_guard::Warning::UNKNOWN; }},
      {"the guard is silent", [](auto& state) { state.warns = false; }},
      {"no new separating planes", [](auto& state) { state.finds_planes = false; }},
      {"no new tool pose", [](auto& state) { state.has_pose = false; }}};
  Inbox<std_msgs::Bool> locks(node_, "/twist/motion_guard/lock");
  Inbox<std_msgs::Float64> scales(node_, "/twist/motion_guard/velocity_scale");
  for (const auto& [cause, change] : cases) {
    awaitFreeMotion();
    locks.await([](const std_msgs::Bool& lock) { return !lock.data; }, "no lock");
    scales.await([](const std_msgs::Float64& scale) { return scale.data == 1.0; }, "scale 1");
    statuses_.clear();
    world_.change(change);
    guarded_twists_.await(isZero, "zero: " + cause);
    const MotionStatus status =
        awaitStatus([&, &cause = cause](const MotionStatus& next) { return next.cause == cause; }, cause);
    EXPECT_EQ(status.code, MotionStatus::HALT_FOR_COLLISION);
    locks.await([](const std_msgs::Bool& lock) { return lock.data; }, "a lock");
    scales.await([](const std_msgs::Float64& scale) { return scale.data == 0.0; }, "scale 0");
    SetUp();
  }
}

TEST_F(MotionGuardNodeTest, FollowsTheToolInTf) {
  const ros::Publisher commands = node_.advertise<Twist>("/in_tf/command", 10);
  Inbox<Twist> guarded(node_, "/in_tf/guarded_command");
  Inbox<MotionStatus> statuses(node_, "/in_tf/motion_guard/status");
  command(twist(-0.1), commands);
  guarded.await([](const Twist& sent) { return sent == twist(-0.1); }, "free motion");
  place(0.0005);
  guarded.await(isZero, "zero before the wall");
  command(twist(0.37), commands);
  guarded.await([](const Twist& sent) { return sent == twist(0.37); }, "the retreat");
  place(0.8);
  command(twist(-0.1), commands);
  guarded.await([](const Twist& sent) { return sent == twist(-0.1); }, "free motion again");
  world_.change([](auto& state) { state.has_pose = false; });
  guarded.await(isZero, "zero without transforms");
  statuses.await([](const MotionStatus& next) { return next.cause == "no new tool pose"; }, "the cause");
}

// Nothing would show what a command does to it.
TEST_F(MotionGuardNodeTest, AToolThatOnlyStaticTransformsPlaceIsNotMovedAndTheTextSaysWhy) {
  const ros::Publisher commands = node_.advertise<Twist>("/resting/command", 10);
  Inbox<Twist> guarded(node_, "/resting/guarded_command");
  Inbox<MotionStatus> statuses(node_, "/resting/motion_guard/status");
  command(twist(-0.1), commands);
  const std::string why = "only static transforms place 'turned' in 'world'";
  const MotionStatus status =
      statuses.await([&](const MotionStatus& next) { return has(next.text, why); }, "why nothing moves");
  EXPECT_EQ(status.code, MotionStatus::HALT_FOR_COLLISION);
  EXPECT_EQ(status.cause, "no tool pose yet");
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(isZero(guarded.await([](const Twist&) { return true; }, "what is sent")));
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics(node_, "/diagnostics");
  const auto says_why = [&](const auto& line) { return line.message.find(why) == 0; };
  diagnostics.await(
      [&](const diagnostic_msgs::DiagnosticArray& next) {
        return std::any_of(next.status.begin(), next.status.end(), says_why);
      },
      "the line of the tool pose");
}

// The zero is sent at the first of these times at which nothing is let through.
TEST(HoldPublisherTest, AScaleOfZeroAndALockFollowTheZeroThatIsSentBefore) {
  ros::NodeHandle node("hold_publisher_test");
  Inbox<std_msgs::Bool> locks(node, "lock");
  Inbox<std_msgs::Float64> scales(node, "velocity_scale");
  HoldPublisher hold(node);
  const auto expect = [&](bool holds) {
    EXPECT_EQ(locks.await([](const std_msgs::Bool&) { return true; }, "a lock").data, holds);
    EXPECT_EQ(scales.await([](const std_msgs::Float64&) { return true; }, "a scale").data, holds ? 0.0 : 1.0);
  };
  const auto at = [](int ms) { return sweep_guard_core::SteadyTime(std::chrono::milliseconds(ms)); };
  const auto publish = [&](bool lets_through, int ms) { hold.publish(lets_through, at(ms)); };
  publish(false, 1000);
  expect(true);  // nothing was let through yet
  publish(true, 1020);
  expect(false);
  publish(false, 1100);
  expect(false);
  publish(false, 1119);
  expect(false);
  publish(false, 1120);
  expect(true);
  publish(true, 1140);
  expect(false);
  hold.hold();
  expect(true);
}

// On a busy machine one of several tries gets them all: a newer command replaces one that has not left.
TEST_F(MotionGuardNodeTest, SendsFourZerosAfterTheCommandsHaveStopped) {
  int zeros = 0;
  for (int i = 0; zeros != 4; ++i) {
    ASSERT_LT(i, 10) << zeros << " zeros";
    awaitFreeMotion();
    statuses_.clear();
    world_.change([](auto& state) { state.command = nullptr; });
    awaitStatus([](const MotionStatus& next) { return next.cause == "the newest command is too old"; }, "idle");
    for (int j = 0; j < 3; ++j) awaitStatus([](const MotionStatus&) { return true; }, "the time of a status");
    zeros = 0;
    command(twist(0.2));
    guarded_twists_.await(
        [&](const Twist& sent) {
          if (sent == twist(0.1)) zeros = 0;
          if (isZero(sent)) ++zeros;
          return sent == twist(0.2);
        },
        "the next command");
    EXPECT_LE(zeros, 4);
  }
}

// Calls for each 20th command of the world: at 5 Hz.
std::function<void(const ros::Time&)> slowly(std::function<void(const ros::Time&)> command) {
  return [command = std::move(command), step = 0](const ros::Time& now) mutable {
    if (step++ % 20 == 0) command(now);
  };
}

/// The node whose command_timeout is longer than the period of its commands.
struct SlowNode {
  explicit SlowNode(ros::NodeHandle& node)
      : publisher(node.advertise<TwistStamped>("/slow/command", 10)), guarded(node, "/slow/guarded_command") {}

  // Each is counted.
  std::function<void(const ros::Time&)> commands(const Twist& twist) const {
    return slowly([out = publisher, counted = count, twist](const ros::Time& now) {
      TwistStamped stamped;
      stamped.header.frame_id = "world";
      stamped.header.stamp = now;
      stamped.twist = twist;
      out.publish(stamped);
      ++*counted;
    });
  }

  ros::Publisher publisher;
  Inbox<TwistStamped> guarded;
  std::shared_ptr<std::atomic<int>> count = std::make_shared<std::atomic<int>>(0);
};

// Returns whether 12 messages in a row are the command, each of another time, while at most half as many were commanded.
bool isRepeated(SlowNode& node, const Twist& command) {
  node.guarded.await([&](const TwistStamped& sent) { return sent.twist == command; }, "free motion");
  const int before = *node.count;
  std::set<ros::Time> stamps;
  for (int i = 0; i < 12; ++i) {
    const TwistStamped sent = node.guarded.await([](const TwistStamped&) { return true; }, "the next one");
    if (!(sent.twist == command)) return false;
    stamps.insert(sent.header.stamp);
  }
  return stamps.size() == 12 && 2 * (*node.count - before) <= 12;
}

// On a busy machine, where inputs pause, in one of several tries.
TEST_F(MotionGuardNodeTest, SlowCommandsAreRepeatedUntilTheNextOne) {
  SlowNode node(node_);
  for (const Twist& each : {twist(0.1), twist(-0.1, 0.05), twist(0.0, 0.0, 0.3)}) {
    world_.change([&](auto& state) { state.command = node.commands(each); });
    bool repeated = false;
    for (int i = 0; i < 10 && !repeated; ++i) repeated = isRepeated(node, each);
    EXPECT_TRUE(repeated);
  }
}

// On a busy machine one of several tries is repeated before its time is over.
TEST_F(MotionGuardNodeTest, ARepeatedCommandIsLimitedAnew) {
  SlowNode node(node_);
  for (const double speed : {0.1, 0.15, 0.2}) {
    const Twist fast = twist(-speed, 0.05);
    bool is_slowed = false;
    for (int i = 0; i < 10 && !is_slowed; ++i) {
      world_.change([&](auto& state) { state.command = node.commands(fast); });
      node.guarded.await([&](const TwistStamped& sent) { return sent.twist == fast; }, "free motion");
      world_.change([](auto& state) {
        state.command = nullptr;
        state.wall = 0.795;
      });
      node.guarded.await(
          [&](const TwistStamped& sent) {
            if (sent.twist.linear.x > -0.08 && sent.twist.linear.y > 0.04) is_slowed = true;
            return isZero(sent.twist);
          },
          "zero after command_timeout");
      world_.change([](auto& state) { state.wall = 0.0; });
    }
    EXPECT_TRUE(is_slowed) << "without a new command";
  }
}

TEST_F(MotionGuardNodeTest, SaysThatCommandsComeMoreRarelyThanTheyAreInForce) {
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics(node_, "/diagnostics");
  world_.change(
      [&](auto& state) { state.command = slowly([this](const ros::Time& /*now*/) { twist_.publish(twist(0.1)); }); });
  const MotionStatus status =
      awaitStatus([](const MotionStatus& next) { return has(next.text, "commands come every 0.2"); }, "the period");
  EXPECT_TRUE(has(status.text, "apart, but command_timeout is 0.1 s")) << status.text;
  EXPECT_EQ(status.cause, "the newest command is too old");
  diagnostics.await(
      [](const diagnostic_msgs::DiagnosticArray& next) {
        return std::any_of(next.status.begin(), next.status.end(), [](const auto& each) {
          return each.name == "twist/motion_guard: command" && each.level == diagnostic_msgs::DiagnosticStatus::WARN &&
                 has(each.message, "commands come every 0.2");
        });
      },
      "a warning with the period");
}

TEST(AbsentGuardTest, NamesTheTopicAndTheArgumentToGive) {
  EXPECT_EQ(
      absentGuardText("/robot1/sweep_guard"),
      "nobody publishes /robot1/sweep_guard/warning: start the guard, or give guard:=/sweep_guard if it is at the "
      "root");
  EXPECT_EQ(absentGuardText("/a/b/left"),
            "nobody publishes /a/b/left/warning: start the guard, or give guard:=/left if it is at the root");
  EXPECT_EQ(
      absentGuardText("/sweep_guard"),
      "nobody publishes /sweep_guard/warning: start the guard, or give guard:=/NAMESPACE/sweep_guard if it is in a "
      "namespace");
  EXPECT_EQ(
      absentWarningText("/robot1/sweep_guard/warning"),
      "nobody publishes /robot1/sweep_guard/warning: start the guard, or give warning:=/sweep_guard/warning if it "
      "is at the root");
}

TEST_F(MotionGuardNodeTest, SaysThatNoGuardIsInItsNamespaceAndWhichArgumentToGive) {
  const ros::Publisher commands = node_.advertise<Twist>("/lonely/command", 10);
  Inbox<MotionStatus> statuses(node_, "/lonely/motion_guard/status");
  Inbox<Twist> guarded(node_, "/lonely/guarded_command");
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics(node_, "/diagnostics");
  command(twist(0.1), commands);
  EXPECT_TRUE(isZero(guarded.await([](const Twist&) { return true; }, "zero")));
  const std::string text = absentGuardText("/lonely/sweep_guard");
  statuses.await([&](const MotionStatus& next) { return next.text == "stopped: " + text; }, text);
  diagnostics.await(
      [&](const diagnostic_msgs::DiagnosticArray& next) {
        return std::any_of(next.status.begin(), next.status.end(), [&](const auto& each) {
          return each.name == "lonely/motion_guard: guard" && each.message == text;
        });
      },
      text);
}

TEST_F(MotionGuardNodeTest, ACommandThatIsTooOldIsZero) {
  Inbox<MotionStatus> statuses(node_, "/stamped/motion_guard/status");
  world_.change([=](auto& state) {
    state.command = [=](const ros::Time& now) {
      TwistStamped old;
      old.header.frame_id = "world";
      old.header.stamp = now - ros::Duration(0.5);
      old.twist = twist(0.1);
      stamped_.publish(old);
    };
  });
  guarded_stamped_.await([](const TwistStamped& sent) { return isZero(sent.twist); }, "zero");
  statuses.await([](const MotionStatus& next) { return has(next.text, "the stamp of the newest command is 0.5"); },
                 "how old it is");
}

TEST_F(MotionGuardNodeTest, EscapesSlowlyAndOnlyAway) {
  place(0.01);
  world_.change([](auto& state) {
    state.level = sweep_guard::Warning::UNKNOWN;
    state.reasons = sweep_guard::Warning::POSE_STALE;
  });
  commandStamped(twist(0.2));
  const TwistStamped sent = guarded_stamped_.await(
      [](const TwistStamped& next) { return next.twist.linear.x > 0.0 && next.twist.linear.x < 0.1; }, "an escape");
  EXPECT_NEAR(sent.twist.linear.x, 0.01, 1e-9);
  commandStamped(twist(-0.2));
  guarded_stamped_.await([](const TwistStamped& next) { return isZero(next.twist); }, "zero");
}

// The x axis of the tool points along y of the world, so only its y axis leads to the wall.
TEST_F(MotionGuardNodeTest, ACommandIsAlongTheAxesOfItsFrame) {
  world_.change([](auto& state) {
    state.X_WT = Eigen::Translation3d(0.0005, 0.0, 0.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  });
  commandStamped(twist(0.2, 0.3), "tool");
  const TwistStamped sent = guarded_stamped_.await(
      [](const TwistStamped& next) { return next.twist.linear.x > 0.19 && std::abs(next.twist.linear.y) < 0.01; },
      "the part along the wall");
  EXPECT_NEAR(sent.twist.linear.x, 0.2, 1e-6);
  EXPECT_EQ(sent.header.frame_id, "tool");
}

TEST_F(MotionGuardNodeTest, ACommandInAnUnknownFrameIsRefused) {
  commandStamped(twist(0.2), "nowhere");
  guarded_stamped_.await([](const TwistStamped& next) { return isZero(next.twist); }, "zero");
  Inbox<std_msgs::Int8> codes(node_, "/stamped/motion_guard/servo_status");
  codes.await([](const std_msgs::Int8& code) { return code.data == MotionStatus::INVALID; }, "INVALID");
}

TEST_F(MotionGuardNodeTest, ACommandThatIsNotFiniteIsRefused) {
  awaitFreeMotion();
  command(twist(std::nan("")));
  guarded_twists_.await(isZero, "zero");
  const MotionStatus status =
      awaitStatus([](const MotionStatus& next) { return next.code == MotionStatus::INVALID; }, "INVALID");
  EXPECT_TRUE(has(status.text, "must be finite"));
}

// On a busy machine, where inputs pause, in one of several tries.
TEST_F(MotionGuardNodeTest, APoseIsCaughtUpWithAndHeldWhenTheGuardDoesNotKnow) {
  Inbox<MotionStatus> statuses(node_, "/pose/motion_guard/status");
  int held = 0;
  for (int i = 0; i < 10 && held < 20; ++i) {
    world_.change([](auto& state) { state.level = sweep_guard::Warning::CLEAR; });
    moveRobotTo(0.81);
    world_.change([](auto& state) { state.level = sweep_guard::Warning::UNKNOWN; });
    statuses.await([](const MotionStatus& next) { return next.cause == "the guard's level is UNKNOWN"; }, "stopped");
    commandPose(Eigen::Isometry3d(Eigen::Translation3d(0.9, 0.0, 0.0)));
    guarded_poses_.clear();
    for (held = 0; held < 20; ++held) {
      const PoseStamped sent = guarded_poses_.await([](const PoseStamped&) { return true; }, "the pose of before");
      if (std::abs(sent.pose.position.x - 0.81) > 1e-9) break;
    }
    statuses.clear();
  }
  EXPECT_EQ(held, 20);
}

// The robot was stopped by somebody else, and is released.
TEST_F(MotionGuardNodeTest, APoseWaitsForAToolThatStandsAndIsTakenBackToItWhenTheGuardDoesNotKnow) {
  constexpr double kReach = 0.25 * 0.03;  // max_speed * lag/time_constant
  Inbox<MotionStatus> statuses(node_, "/pose/motion_guard/status");
  stands_ = true;
  startRobot();
  commandPose(Eigen::Isometry3d(Eigen::Translation3d(1.2, 0.0, 0.0)));
  // After the test before, it may wait nearer to the tool for a moment.
  const auto waits = [](const MotionStatus& next) {
    return next.cause == "the tool does not follow" &&
           has(next.text, "the pose sent waits 7.5 mm and 0.0 degrees ahead of it");
  };
  const MotionStatus status = statuses.await(waits, "that it does not follow, and how far ahead the pose waits");
  EXPECT_NE(status.code, MotionStatus::NO_WARNING);
  guarded_poses_.clear();
  for (int i = 0; i < 50; ++i) {
    const PoseStamped sent = guarded_poses_.await([](const PoseStamped&) { return true; }, "the next pose");
    EXPECT_LE(sent.pose.position.x, 0.8 + kReach + 1e-9);
  }
  // On a busy machine, where inputs pause, it is taken back to the tool for a while.
  guarded_poses_.await([](const PoseStamped& sent) { return sent.pose.position.x > 0.8; }, "a pose that waits");
  world_.change([](auto& state) { state.level = sweep_guard::Warning::UNKNOWN; });
  guarded_poses_.await([](const PoseStamped& next) { return std::abs(next.pose.position.x - 0.8) < 1e-9; },
                       "the pose of the tool");
  world_.change([](auto& state) { state.level = sweep_guard::Warning::CLEAR; });
  stands_ = false;
  guarded_poses_.await([](const PoseStamped& next) { return next.pose.position.x == 1.2; }, "the commanded pose");
  statuses.await([](const MotionStatus& next) { return next.cause == "guarded"; }, "that it follows");
}

TEST_F(MotionGuardNodeTest, APoseBeyondAWallThatCameIsTakenBackToTheTool) {
  commandPose(Eigen::Isometry3d(Eigen::Translation3d(-0.5, 0.0, 0.0)));
  guarded_poses_.await([](const PoseStamped& next) { return next.pose.position.x < 0.794; },
                       "a pose ahead of the tool");
  world_.change([](auto& state) { state.wall = 0.797; });
  guarded_poses_.await([](const PoseStamped& next) { return next.pose.position.x >= 0.799 - 1e-6; }, "one at the tool");
  for (int i = 0; i < 50; ++i) {
    const PoseStamped next = guarded_poses_.await([](const PoseStamped&) { return true; }, "the next pose");
    EXPECT_GE(next.pose.position.x, 0.799 - 1e-6);
  }
}

TEST_F(MotionGuardNodeTest, APoseThatIsRefusedIsAnsweredInTheFrameOfTheOneBefore) {
  moveRobotTo(0.81);
  commandPose(Eigen::Isometry3d(Eigen::Translation3d(0.9, 0.0, 0.0)), "nowhere");
  Inbox<MotionStatus> statuses(node_, "/pose/motion_guard/status");
  statuses.await([](const MotionStatus& next) { return next.code == MotionStatus::INVALID; }, "refused");
  guarded_poses_.clear();
  for (int i = 0; i < 20; ++i) {
    const PoseStamped held = guarded_poses_.await([](const PoseStamped&) { return true; }, "the pose of before");
    EXPECT_EQ(held.header.frame_id, "world");
    EXPECT_NEAR(held.pose.position.x, 0.81, 1e-9);
  }
}

TEST_F(MotionGuardNodeTest, AStampedCommandWithoutAFrameIsRefused) {
  commandStamped(twist(0.2), "");
  Inbox<MotionStatus> statuses(node_, "/stamped/motion_guard/status");
  const MotionStatus status =
      statuses.await([](const MotionStatus& next) { return next.code == MotionStatus::INVALID; }, "refused");
  EXPECT_TRUE(has(status.text, "set command_frame"));
  guarded_stamped_.await([](const TwistStamped& next) { return isZero(next.twist); }, "zero");
}

// It may have turned since.
TEST_F(MotionGuardNodeTest, ACommandInAFrameWhoseTransformIsOldIsRefused) {
  const ros::Publisher transforms = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  Inbox<MotionStatus> statuses(node_, "/stamped/motion_guard/status");
  commandStamped(twist(0.2), "camera");
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = "world";
  message.transforms[0].child_frame_id = "camera";
  message.transforms[0].transform.rotation.w = 1.0;
  TwistStamped sent;
  for (int i = 0; i < 2'000 && sent.twist.linear.x != 0.2; ++i) {  // it may take seconds until the node hears of it
    message.transforms[0].header.stamp = ros::Time::now() + ros::Duration(1.0);
    if (i % 100 == 0) transforms.publish(message);
    sent = guarded_stamped_.await([](const TwistStamped&) { return true; }, "the next twist");
  }
  EXPECT_EQ(sent.twist.linear.x, 0.2) << "free motion";
  statuses.await([](const MotionStatus& next) { return has(next.text, "the transform from 'camera' to 'world' is"); },
                 "that it is old");
  guarded_stamped_.await([](const TwistStamped& next) { return isZero(next.twist); }, "zero");
}

TEST_F(MotionGuardNodeTest, StopsWhileTwoGuardsPublish) {
  awaitFreeMotion();
  const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("sweep_guard_node");
  const ChildProcess second({program.string(), "__name:=second", "~proximity:=/fake/proximity"});
  guarded_twists_.await(isZero, "zero");
  awaitStatus([](const MotionStatus& next) { return next.cause == "no new separating planes"; }, "no planes");
}

TEST_F(MotionGuardNodeTest, APoseThatIsOldByItsStampStopsTheTool) {
  awaitFreeMotion();
  world_.change([](auto& state) { state.pose_age = ros::Duration(0.6); });
  guarded_twists_.await(isZero, "zero");
  awaitStatus([](const MotionStatus& next) { return next.cause == "the newest tool pose is too old"; }, "an old pose");
}

TEST_F(MotionGuardNodeTest, APoseBehindAPlaneIsNotReached) {
  place(0.05);
  startRobot();
  commandPose(Eigen::Isometry3d(Eigen::Translation3d(-0.02, 0.0, 0.0)));
  const PoseStamped sent = guarded_poses_.await([](const PoseStamped& next) { return next.pose.position.x < 0.0022; },
                                                "a pose near the standoff");
  EXPECT_GE(sent.pose.position.x, 0.002 - 1e-6);
  for (int i = 0; i < 50; ++i) {
    const PoseStamped next = guarded_poses_.await([](const PoseStamped&) { return true; }, "the next pose");
    EXPECT_GE(next.pose.position.x, 0.002 - 1e-6);
  }
}

TEST_F(MotionGuardNodeTest, RebasingIsRefusedUnlessPosesAreIncremental) {
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::waitForService("/twist/motion_guard/rebase", 20'000));
  ASSERT_TRUE(ros::service::call("/twist/motion_guard/rebase", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_TRUE(has(call.response.message, "incremental"));
}

TEST_F(MotionGuardNodeTest, IncrementalPosesMoveTheToolFromWhereItIs) {
  Inbox<PoseStamped> guarded(node_, "/clutch/guarded_command");
  Inbox<MotionStatus> statuses(node_, "/clutch/motion_guard/status");
  const auto count = std::make_shared<std::atomic<int>>();  // of guarded poses
  const ros::Subscriber counter = node_.subscribe<PoseStamped>(
      "/clutch/guarded_command", 1000, [count](const boost::shared_ptr<const PoseStamped>&) { ++*count; });
  const ros::Publisher poses = node_.advertise<PoseStamped>("/clutch/command", 10);
  const auto command = [&](double x) {
    world_.change([=](auto& state) {
      state.command = [=](const ros::Time& now) {
        PoseStamped pose;
        pose.header.frame_id = "world";
        pose.header.stamp = now;
        pose.pose = toMsg(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)));
        poses.publish(pose);
      };
    });
  };
  const auto next = [&] { return guarded.await([](const PoseStamped&) { return true; }, "a pose").pose.position.x; };
  command(5.0);
  double sent = next();
  for (int i = 0; i < 20 && std::abs(sent - 0.8) > 1e-9; ++i) {  // the node may still know the pose of the test before
    world_.change([](auto& state) { state.command = {}; });
    statuses.clear();
    statuses.await([](const MotionStatus& status) { return status.cause == "the newest command is too old"; }, "idle");
    for (int before = -1; before != *count;) {  // until the zeros are over
      before = *count;
      for (int j = 0; j < 20; ++j) statuses.await([](const MotionStatus&) { return true; }, "the time of a status");
    }
    guarded.clear();
    command(5.0);
    sent = next();
  }
  ASSERT_NEAR(sent, 0.8, 1e-9);
  double commanded = 5.0;
  // What is commanded before the node hears the guard again is lost: the topics of the world are new in each test.
  for (int i = 0; i < 2'000 && sent < 0.8005; ++i) {
    command(commanded += 1e-4);
    sent = next();
  }
  EXPECT_GE(sent, 0.8005);
  EXPECT_LT(sent, 0.85);
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("/clutch/motion_guard/rebase", call));
  EXPECT_TRUE(call.response.success);
}

TEST_F(MotionGuardNodeTest, ATwistIsAlongCommandFrame) {
  place(0.0005);
  command(twist(0.2, 0.3), tip_);
  const Twist sent = guarded_tip_.await(
      [](const Twist& next) { return next.linear.x > 0.19 && std::abs(next.linear.y) < 0.01; }, "the part along");
  EXPECT_NEAR(sent.linear.x, 0.2, 1e-6);
}

// The needle is parallel to the wall. A turn about its origin moves the tip to the wall, a turn about the tip moves the
// origin away.
TEST_F(MotionGuardNodeTest, ATwistIsOfCommandPoint) {
  world_.change([](auto& state) {
    state.X_WT = Eigen::Translation3d(0.0021, 0.0, 0.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  });
  const Twist turn = twist(0.0, 0.0, 0.3);
  command(turn);
  guarded_twists_.await([](const Twist& sent) { return sent.angular.z < 0.1; }, "a slow turn about the origin");
  command(turn, tip_);
  guarded_tip_.await([&](const Twist& sent) { return sent == turn; }, "the turn about the tip");
  command(twist(0.0, 0.0, -0.3), tip_);
  guarded_tip_.await([](const Twist& sent) { return sent.angular.z > -0.1; }, "a slow turn the other way");
}

TEST_F(MotionGuardNodeTest, ARefusedParameterEndsTheNodeWithOneLine) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("motion_guard_node");
  ChildProcess node({program.string(), "__name:=refused", "_standoff:=-1.0"});
  EXPECT_EQ(node.wait(), 2);
  EXPECT_TRUE(has(node.output(), "/refused/standoff is -1, but must be a number from 0 to 1"));
}

TEST_F(MotionGuardNodeTest, ASecondPublisherIsAnErrorInTheDiagnostics) {
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics(node_, "/diagnostics");
  const ros::Publisher second = node_.advertise<Twist>("/twist/guarded_command", 1);
  diagnostics.await(
      [](const diagnostic_msgs::DiagnosticArray& next) {
        return std::any_of(next.status.begin(), next.status.end(), [](const auto& status) {
          return status.level == diagnostic_msgs::DiagnosticStatus::ERROR &&
                 status.message.find("publishes on /twist/guarded_command, past the guard") != std::string::npos;
        });
      },
      "an error about the second publisher");
}

}  // namespace
}  // namespace sweep_guard_ros

int main(int argc, char** argv) {
  ros::init(argc, argv, "motion_guard_test");
  const ros::NodeHandle alive;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
