// Which of the goals of an action is under way, by its states.
#include "ros/service/trajectory_goals.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using actionlib_msgs::GoalStatus;
using std::chrono::milliseconds;
using sweep_guard_core::SteadyTime;

struct State {
  std::string id;
  double stamp;  // of the goal [s]
  std::uint8_t status;
};

class TrajectoryGoalsTest : public testing::Test {
 protected:
  static TrajectoryGoals::Trajectory trajectory() {
    const sweep_guard_core::KinematicTree none({}, {});
    return std::make_shared<const sweep_guard_core::JointTrajectory>(
        none, sweep_guard_core::JointsBesideTree{{}, {"wheel"}},
        sweep_guard_core::TrajectoryPlan{{"wheel"}, {{{}, {0.0}}}}, sweep_guard_core::Time(), std::vector<double>());
  }
  void tell(const std::vector<State>& states) {
    actionlib_msgs::GoalStatusArray msg;
    for (const State& state : states) {
      GoalStatus& one = msg.status_list.emplace_back();
      one.goal_id.id = state.id;
      one.goal_id.stamp = ros::Time(state.stamp);
      one.status = state.status;
    }
    goals_.setStates(msg, now_);
  }

  const SteadyTime now_ = SteadyTime(std::chrono::hours(1));
  TrajectoryGoals goals_;
};

TEST_F(TrajectoryGoalsTest, AGoalIsUnderWayWhileItIsActive) {
  const auto one = trajectory();
  goals_.add({"one", one});
  for (std::uint8_t status = GoalStatus::PENDING; status <= GoalStatus::LOST; ++status) {
    tell({{"one", 1.0, status}});
    EXPECT_EQ(goals_.underWay(now_).trajectory, status == GoalStatus::ACTIVE ? one : nullptr) << int{status};
    EXPECT_EQ(goals_.underWay(now_).problem, "");
  }
}

TEST_F(TrajectoryGoalsTest, OfSeveralTheNewestCountsAndThatIsTold) {
  const auto older = trajectory();
  const auto newer = trajectory();
  goals_.add({"newer", newer});
  goals_.add({"older", older});
  const State of_older{"older", 1.0, GoalStatus::ACTIVE};
  const State of_newer{"newer", 2.0, GoalStatus::ACTIVE};
  for (const auto& states : {std::vector<State>{of_older, of_newer}, std::vector<State>{of_newer, of_older}}) {
    tell(states);
    EXPECT_EQ(goals_.underWay(now_).trajectory, newer);
    EXPECT_EQ(goals_.underWay(now_).problem, "2 goals are under way: only the newest is watched");
  }
}

TEST_F(TrajectoryGoalsTest, ASilentServerHasNoGoal) {
  const auto one = trajectory();
  goals_.add({"one", one});
  EXPECT_EQ(goals_.underWay(now_).problem, "the action server has not been heard of");
  tell({{"one", 1.0, GoalStatus::ACTIVE}});
  EXPECT_EQ(goals_.underWay(now_ + milliseconds(1000)).trajectory, one);
  EXPECT_EQ(goals_.underWay(now_ + milliseconds(1001)).trajectory, nullptr);
  EXPECT_TRUE(has(goals_.underWay(now_ + milliseconds(1001)).problem, "the action server has been silent for 1"));
}

TEST_F(TrajectoryGoalsTest, KeepsTheNewestSixteen) {
  goals_.add({"refused", nullptr, "it has no points"});
  goals_.add({"one", trajectory()});
  tell({{"refused", 1.0, GoalStatus::ACTIVE}});
  EXPECT_EQ(goals_.underWay(now_).problem, "goal 'refused' is under way, but was refused: it has no points");
  for (int i = 0; i < 15; ++i) goals_.add({"another", trajectory()});
  EXPECT_EQ(goals_.underWay(now_).problem, "goal 'refused' is under way, but was not received");
  tell({{"one", 1.0, GoalStatus::ACTIVE}});
  EXPECT_NE(goals_.underWay(now_).trajectory, nullptr);
}

}  // namespace
}  // namespace sweep_guard_ros
