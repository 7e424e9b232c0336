// The arm of arm.urdf along x, 1 m above the origin. Its shoulder follows trajectories in real time, as a controller says.
#include <gtest/gtest.h>
#include <std_msgs/Bool.h>
#include <sweep_guard/Prediction.h>
#include <sweep_guard/TrajectoryStatus.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fake_controller.h"
#include "guard_probe.h"
#include "listener.h"
#include "message_md5.h"
#include "refusal.h"
#include "scenes.h"

namespace sweep_guard_ros {
namespace {

using actionlib_msgs::GoalStatus;
using sweep_guard::Prediction;
using sweep_guard::TrajectoryStatus;
using sweep_guard::Warning;

const Eigen::Vector3d kFar(0.0, 0.0, -3.0);
constexpr double kHalfSide = 0.02;  // [m], of the square

// Of a square that the forearm meets when the shoulder is at an angle; the forearm is 2 cm thick.
Eigen::Vector3d onTheWayTo(double shoulder) { return {0.4 * std::cos(shoulder), 0.0, 1.0 - 0.4 * std::sin(shoulder)}; }

class Arm {
 public:
  Arm() {
    mount_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true);
    tf2_msgs::TFMessage message;
    geometry_msgs::TransformStamped& base = message.transforms.emplace_back();
    base.header.frame_id = "world";
    base.child_frame_id = "base";
    base.transform.translation.z = 1.0;
    base.transform.rotation.w = 1.0;
    mount_.publish(message);
    probe.publish(squareAt("square", kFar, ros::Time::now(), kHalfSide));
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!controller.isHeard()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("nobody listens to the controller");
      status.next();
    }
  }

  GuardProbe probe{/*drives_clock=*/false, ProbeSource::kTf};
  FakeController controller{"/arm_controller/follow_joint_trajectory"};
  const Listener<TrajectoryStatus> status{"/sweep_guard/trajectory"};
  const Listener<std_msgs::Bool> clear{"/sweep_guard/trajectory_clear"};
  const Listener<Prediction> prediction{"/sweep_guard/prediction"};

 private:
  ros::Publisher mount_;
};

Arm& arm() {
  static Arm arm;
  return arm;
}

FakeController& controller() { return arm().controller; }

void moveSquare(const Eigen::Vector3d& center) {
  arm().probe.publish(squareMovedTo("square", center, ros::Time::now(), kHalfSide));
}

bool isIdle(const TrajectoryStatus& status) { return !status.watching && status.text == "no trajectory is under way"; }
bool isClear(const TrajectoryStatus& status) { return status.clear; }
bool meetsSquare(const TrajectoryStatus& status) { return status.mesh_id == "square"; }

TrajectoryStatus awaitStatus(const std::string& what, const std::function<bool(const TrajectoryStatus&)>& fits) {
  TrajectoryStatus newest;
  try {
    return arm().status.await(what, [&](const TrajectoryStatus& status) {
      newest = status;
      return fits(status);
    });
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + std::string("; newest text: ") + newest.text);
  }
}

TrajectoryStatus awaitText(const std::string& part) {
  return awaitStatus(part, [&](const TrajectoryStatus& status) { return has(status.text, part); });
}

class TrajectoryWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    moveSquare(kFar);
    controller().rest(0.0);
    controller().tell({});
    awaitStatus("no trajectory", isIdle);
  }
};

TEST_F(TrajectoryWatchTest, ATrajectoryUnderWayIsPredictedAndItsRestIsClear) {
  controller().execute(shoulderGoal("one", {}, {{0.0, 0.0}, {60.0, 1.2}}));
  const TrajectoryStatus status = awaitStatus("a clear rest", isClear);
  EXPECT_TRUE(status.watching);
  EXPECT_EQ(status.text, "");
  EXPECT_EQ(status.mesh_id, "");
  EXPECT_EQ(status.time, ros::Duration(-1.0));
  EXPECT_EQ(status.header.frame_id, "world");
  EXPECT_GT(status.valid_until, status.header.stamp);
  arm().clear.await("the flag", [](const std_msgs::Bool& flag) { return flag.data != 0; });
  arm().prediction.await("its prediction",
                         [](const Prediction& next) { return next.prediction_source == "trajectory"; });
}

TEST_F(TrajectoryWatchTest, OnlyAnActiveGoalIsWatched) {
  const auto goal = shoulderGoal("one", {}, {{0.0, 0.0}, {60.0, 1.2}});
  controller().send(goal);
  controller().follow(goal);
  for (const auto state : {GoalStatus::PENDING, GoalStatus::PREEMPTING, GoalStatus::PREEMPTED, GoalStatus::SUCCEEDED,
                           GoalStatus::ABORTED, GoalStatus::REJECTED, GoalStatus::RECALLED, GoalStatus::LOST}) {
    controller().tell({{goal.goal_id, state}});
    awaitStatus("a state that is not active", isIdle);
    arm().clear.await("the flag", [](const std_msgs::Bool& flag) { return flag.data == 0; });
    controller().tell({{goal.goal_id, GoalStatus::ACTIVE}});
    awaitStatus("an active goal", isClear);
  }
  controller().tell({});
  arm().prediction.await("a measured one", [](const Prediction& next) { return next.prediction_source == "measured"; });
}

TEST_F(TrajectoryWatchTest, TheRestThatMeetsAWorkpieceSaysWhenAndWithWhat) {
  const ros::Time begin = ros::Time::now();
  controller().execute(shoulderGoal("one", begin, {{0.0, 0.0}, {12.0, 1.2}}));
  awaitStatus("a clear rest", isClear);
  moveSquare(onTheWayTo(1.0));
  const TrajectoryStatus status = awaitStatus("the square", meetsSquare);
  EXPECT_FALSE(status.clear);
  EXPECT_EQ(status.link, "fore");
  // Its edge nearest in angle: 1 cm above the middle of the forearm, which is then 0.38 m away, or a corner.
  const double shoulder = 0.1 * (status.header.stamp + status.time - begin).toSec();
  EXPECT_NEAR(shoulder, 1.0, 0.09);
  EXPECT_LT(shoulder, 1.0);
  arm().clear.await("the flag", [](const std_msgs::Bool& flag) { return flag.data == 0; });
  moveSquare(kFar);
  awaitStatus("a clear rest", isClear);
}

// The joints rest, and rest on: without the trajectory, nothing would be predicted.
TEST_F(TrajectoryWatchTest, TheLevelRisesBeforeTheRobotMoves) {
  moveSquare(onTheWayTo(0.5));
  arm().probe.skipWarnings();
  const auto goal = shoulderGoal("one", ros::Time::now() + ros::Duration(3.0), {{0.0, 0.0}, {1.0, 1.0}});
  controller().execute(goal);
  const Warning warning = arm().probe.awaitWarning(
      [](const Warning& next) { return next.level == Warning::CONSIDERED && next.mesh_id == "square"; });
  EXPECT_EQ(warning.tool_link, "fore");
  EXPECT_LT(controller().shoulder(), 0.05);
  arm().probe.awaitWarning([](const Warning& next) { return next.level == Warning::REFLEX; });
  EXPECT_GT(controller().shoulder(), 0.2);
}

TEST_F(TrajectoryWatchTest, AReplacedGoalIsNoLongerWatched) {
  moveSquare(onTheWayTo(1.0));
  const auto first = shoulderGoal("first", {}, {{0.0, 0.0}, {12.0, 1.2}});
  controller().execute(first);
  awaitStatus("the square", meetsSquare);
  const auto second = shoulderGoal("second", {}, {{10.0, -1.0}});  // from where the shoulder is
  controller().send(second);
  controller().follow(second);
  controller().tell({{first.goal_id, GoalStatus::PREEMPTED}, {second.goal_id, GoalStatus::ACTIVE}});
  awaitStatus("a clear rest", isClear);
}

TEST_F(TrajectoryWatchTest, OfSeveralActiveGoalsTheNewestIsWatchedAndNothingIsClear) {
  moveSquare(onTheWayTo(1.0));
  const auto first = shoulderGoal("first", {}, {{0.0, 0.0}, {12.0, 1.2}});
  const auto second = shoulderGoal("second", {}, {{0.0, 0.0}, {12.0, -1.2}});
  controller().send(first);
  controller().execute(second);
  controller().tell({{second.goal_id, GoalStatus::ACTIVE}, {first.goal_id, GoalStatus::ACTIVE}});
  const TrajectoryStatus status = awaitText("2 goals are under way: only the newest is watched");
  EXPECT_TRUE(status.watching);
  EXPECT_FALSE(status.clear);
  EXPECT_EQ(status.mesh_id, "");
}

TEST_F(TrajectoryWatchTest, WhatIsNoTrajectoryOfThisRobotIsRefusedInWords) {
  auto other_robot = shoulderGoal("other robot", {}, {{0.0, 0.0}, {6.0, 1.0}});
  other_robot.trajectory.joint_names = {"knee"};
  const std::pair<FollowJointTrajectoryActionGoal, std::string> cases[] = {
      {other_robot, "the robot description has no joint 'knee'"},
      {shoulderGoal("NaN", {}, {{0.0, 0.0}, {6.0, std::nan("")}}),
       "point 1 of the trajectory has a number that is not"},
      {shoulderGoal("times", {}, {{1.0, 0.0}, {1.0, 1.0}}),
       "point 1 of the trajectory is not later than the one before"},
      {shoulderGoal("empty", {}, {}), "trajectory has no points"}};
  for (const auto& [goal, why] : cases) {
    controller().send(goal);
    controller().tell({{goal.goal_id, GoalStatus::ACTIVE}});
    const TrajectoryStatus status = awaitText("goal '" + goal.goal_id.id + "' is under way, but was refused: " + why);
    EXPECT_FALSE(status.watching);
    EXPECT_FALSE(status.clear);
    arm().probe.awaitStatus("trajectory", [&, why = why](const GuardProbe::Status& line) {
      return line.level == GuardProbe::Status::WARN && line.message.find(why) != std::string::npos;
    });
  }
}

TEST_F(TrajectoryWatchTest, AGoalThatWasNotReceivedIsToldOf) {
  actionlib_msgs::GoalID unknown;
  unknown.id = "unknown";
  controller().tell({{unknown, GoalStatus::ACTIVE}});
  EXPECT_FALSE(awaitText("goal 'unknown' is under way, but was not received").clear);
}

TEST_F(TrajectoryWatchTest, ASilentActionServerIsToldOf) {
  controller().execute(shoulderGoal("one", {}, {{0.0, 0.0}, {60.0, 1.2}}));
  awaitStatus("a clear rest", isClear);
  controller().fallSilent();
  EXPECT_FALSE(awaitText("the action server has been silent for 1").clear);
  arm().prediction.await("a measured one", [](const Prediction& next) { return next.prediction_source == "measured"; });
}

TEST_F(TrajectoryWatchTest, ARobotThatDoesNotFollowIsPredictedAsMeasured) {
  const auto goal = shoulderGoal("one", {}, {{0.0, 0.0}, {2.0, 1.2}});
  controller().send(goal);
  controller().tell({{goal.goal_id, GoalStatus::ACTIVE}});
  const TrajectoryStatus status = awaitText("the robot does not follow the trajectory");
  EXPECT_FALSE(status.watching);
  EXPECT_FALSE(status.clear);
  arm().prediction.await("a measured one", [](const Prediction& next) { return next.prediction_source == "measured"; });
}

// SWEEP_GUARD_SCENES=100: 100 of them. Each time, the robot needs more than the horizon to get there.
TEST_F(TrajectoryWatchTest, AWorkpieceThatMovesIntoTheRestIsToldOfWithin300Milliseconds) {
  sweep_guard_core::Random random(/*seed=*/3);
  const int scenes = sweep_guard_core::sceneCount(100, 10.0);
  double longest = 0.0;
  for (int i = 0; i < scenes; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double end = side * random.uniform(0.8, 1.4);
    controller().rest(0.0);
    controller().execute(
        shoulderGoal("scene " + std::to_string(i), {}, {{0.0, 0.0}, {random.uniform(6.0, 20.0), end}}));
    awaitStatus("a clear rest", isClear);
    const auto moved = std::chrono::steady_clock::now();
    moveSquare(onTheWayTo(end * random.uniform(0.6, 0.9)));
    awaitStatus("the square", meetsSquare);
    const double delay = secondsSince(moved);
    longest = std::max(longest, delay);
    EXPECT_LE(delay, 0.3) << "scene " << i;
    moveSquare(kFar);
    controller().tell({});
    awaitStatus("no trajectory", isIdle);
  }
  std::printf("%d scenes, told of within %.3f s\n", scenes, longest);
}

TEST(FollowJointTrajectoryTest, HasTheMd5OfTheOriginalDefinition) {
  const std::string tolerance = md5Of("string name\nfloat64 position\nfloat64 velocity\nfloat64 acceleration");
  const std::string goal = md5Of(md5<trajectory_msgs::JointTrajectory>() + " trajectory\n" + tolerance +
                                 " path_tolerance\n" + tolerance + " goal_tolerance\nduration goal_time_tolerance");
  EXPECT_EQ(
      md5Of(md5<std_msgs::Header>() + " header\n" + md5<actionlib_msgs::GoalID>() + " goal_id\n" + goal + " goal"),
      md5<FollowJointTrajectoryActionGoal>());
  EXPECT_STREQ(ros::message_traits::DataType<FollowJointTrajectoryActionGoal>::value(),
               "control_msgs/FollowJointTrajectoryActionGoal");
}

}  // namespace
}  // namespace sweep_guard_ros
