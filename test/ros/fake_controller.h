#pragma once

#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "repeater.h"
#include "ros/service/follow_joint_trajectory.h"

namespace sweep_guard_ros {

/// Returns a goal for the shoulder of arm.urdf, straight from point to point.
/// @param begin   of the trajectory; 0: on receipt
/// @param points  times from the begin [s], and positions [rad]
inline FollowJointTrajectoryActionGoal shoulderGoal(const std::string& id, ros::Time begin,
                                                    const std::vector<std::pair<double, double>>& points) {
  FollowJointTrajectoryActionGoal msg;
  msg.goal_id.id = id;
  msg.goal_id.stamp = ros::Time::now();
  msg.trajectory.header.stamp = begin;
  msg.trajectory.joint_names = {"shoulder"};
  for (const auto& [seconds, position] : points) {
    auto& point = msg.trajectory.points.emplace_back();
    point.time_from_start = ros::Duration(seconds);
    point.positions = {position};
  }
  return msg;
}

/// Stands in for joint_trajectory_controller of ros_controllers and its action: publishes where the joints of arm.urdf are, and
/// the states of goals as it is told to.
class FakeController {
 public:
  using State = std::uint8_t;  ///< of actionlib_msgs/GoalStatus

  explicit FakeController(const std::string& action) {
    ros::AdvertiseOptions goals;
    goals.topic = action + "/goal";
    goals.queue_size = 10;
    goals.datatype = ros::message_traits::datatype<FollowJointTrajectoryActionGoal>();
    goals.md5sum = ros::message_traits::md5sum<FollowJointTrajectoryActionGoal>();
    goals_ = node_.advertise(goals);
    states_publisher_ = node_.advertise<actionlib_msgs::GoalStatusArray>(action + "/status", 10);
    joints_ = node_.advertise<sensor_msgs::JointState>("joint_states", 1000);
    moves_.emplace(std::chrono::milliseconds(10), [this] { publishJoints(); });
    tells_.emplace(std::chrono::milliseconds(100), [this] { publishStates(); });
  }

  bool isHeard() const {
    return goals_.getNumSubscribers() > 0 && states_publisher_.getNumSubscribers() > 0 &&
           joints_.getNumSubscribers() > 0;
  }

  void send(const FollowJointTrajectoryActionGoal& goal) { goals_.publish(goal); }

  /// Sends a goal, moves the shoulder along it, and calls it ACTIVE.
  void execute(const FollowJointTrajectoryActionGoal& goal) {
    send(goal);
    follow(goal);
    tell({{goal.goal_id, actionlib_msgs::GoalStatus::ACTIVE}});
  }

  /// Moves the shoulder along a goal, or leaves it where it is.
  void follow(const std::optional<FollowJointTrajectoryActionGoal>& goal) {
    const std::lock_guard lock(mutex_);
    shoulder_ = at(ros::Time::now());
    goal_ = goal;
    if (goal_ && goal_->trajectory.header.stamp.isZero()) goal_->trajectory.header.stamp = ros::Time::now();
  }
  /// Puts the shoulder somewhere [rad], at rest.
  void rest(double shoulder) {
    const std::lock_guard lock(mutex_);
    goal_.reset();
    shoulder_ = shoulder;
  }
  double shoulder() const {
    const std::lock_guard lock(mutex_);
    return at(ros::Time::now());
  }

  /// Publishes states now, and ten times a second from now on.
  void tell(const std::vector<std::pair<actionlib_msgs::GoalID, State>>& states) {
    {
      const std::lock_guard lock(mutex_);
      states_.emplace();
      for (const auto& [id, state] : states) {
        states_->status_list.emplace_back();
        states_->status_list.back().goal_id = id;
        states_->status_list.back().status = state;
      }
    }
    publishStates();
  }
  void fallSilent() {
    const std::lock_guard lock(mutex_);
    states_.reset();
  }

 private:
  double at(ros::Time now) const {
    if (!goal_) return shoulder_;
    const auto& trajectory = goal_->trajectory;
    const ros::Duration passed = now - trajectory.header.stamp;
    std::pair<double, double> before(0.0, shoulder_);
    for (const auto& point : trajectory.points) {
      const double seconds = point.time_from_start.toSec();
      if (passed.toSec() < seconds) {
        const double share = std::max(0.0, (passed.toSec() - before.first) / (seconds - before.first));
        return before.second + share * (point.positions[0] - before.second);
      }
      before = {seconds, point.positions[0]};
    }
    return before.second;
  }

  void publishJoints() {
    const std::lock_guard lock(mutex_);
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time::now();
    message.name = {"shoulder", "elbow", "jaw"};
    message.position = {at(message.header.stamp), 0.0, 0.04};
    joints_.publish(message);
  }

  void publishStates() {
    const std::lock_guard lock(mutex_);
    if (states_) states_publisher_.publish(*states_);
  }

  ros::NodeHandle node_;
  mutable std::mutex mutex_;
  double shoulder_ = 0.0;                                // [rad], where no goal says
  std::optional<FollowJointTrajectoryActionGoal> goal_;  // that is followed
  std::optional<actionlib_msgs::GoalStatusArray> states_;
  ros::Publisher goals_;
  ros::Publisher states_publisher_;
  ros::Publisher joints_;
  std::optional<Repeater> moves_;  // these end before what they publish
  std::optional<Repeater> tells_;
};

}  // namespace sweep_guard_ros
