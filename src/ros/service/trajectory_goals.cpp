#include "ros/service/trajectory_goals.h"

#include <algorithm>
#include <utility>

#include "common/number_text.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxGoals = 16;
constexpr auto kSilence = std::chrono::seconds(1);  // actionlib sends states at 5 Hz

}  // namespace

void TrajectoryGoals::add(Goal goal) {
  goals_.push_back(std::move(goal));
  if (goals_.size() > kMaxGoals) goals_.pop_front();
}

void TrajectoryGoals::setStates(const actionlib_msgs::GoalStatusArray& states, sweep_guard_core::SteadyTime received) {
  heard_ = received;
  active_ = 0;
  ros::Time newest;
  for (const actionlib_msgs::GoalStatus& state : states.status_list) {
    if (state.status != actionlib_msgs::GoalStatus::ACTIVE) continue;
    if (active_++ > 0 && state.goal_id.stamp < newest) continue;
    newest = state.goal_id.stamp;
    newest_ = state.goal_id.id;
  }
}

TrajectoryGoals::UnderWay TrajectoryGoals::underWay(sweep_guard_core::SteadyTime now) const {
  if (!heard_) return {nullptr, "the action server has not been heard of"};
  if (now - *heard_ > kSilence)
    return {nullptr, "the action server has been silent for " + sweep_guard_core::inSeconds(now - *heard_)};
  if (active_ == 0) return {};
  const std::string name = "goal '" + sweep_guard_core::printable(newest_) + "'";
  const auto goal = std::find_if(goals_.rbegin(), goals_.rend(), [&](const Goal& one) { return one.id == newest_; });
  if (goal == goals_.rend()) return {nullptr, name + " is under way, but was not received"};
  if (!goal->trajectory) return {nullptr, name + " is under way, but was refused: " + goal->refusal};
  if (active_ == 1) return {goal->trajectory};
  return {goal->trajectory, std::to_string(active_) + " goals are under way: only the newest is watched"};
}

}  // namespace sweep_guard_ros
