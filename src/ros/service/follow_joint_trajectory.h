#pragma once

#include <actionlib_msgs/GoalID.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <string>
#include <vector>

namespace sweep_guard_ros {

/// The message control_msgs/JointTolerance. Debian packages none of control_msgs.
struct JointTolerance {
  std::string name;
  double position = 0.0;      ///< [rad or m]
  double velocity = 0.0;      ///< [rad/s or m/s]
  double acceleration = 0.0;  ///< [rad/s^2 or m/s^2]
};

/// The message control_msgs/FollowJointTrajectoryActionGoal, for subscribers. On the wire, the members of its goal are its own.
struct FollowJointTrajectoryActionGoal {
  std_msgs::Header header;
  actionlib_msgs::GoalID goal_id;
  trajectory_msgs::JointTrajectory trajectory;
  std::vector<JointTolerance> path_tolerance;
  std::vector<JointTolerance> goal_tolerance;
  ros::Duration goal_time_tolerance;
};

}  // namespace sweep_guard_ros

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<sweep_guard_ros::FollowJointTrajectoryActionGoal> {
  static const char* value() { return "cff5c1d533bf2f82dd0138d57f4304bb"; }
  static const char* value(const sweep_guard_ros::FollowJointTrajectoryActionGoal& /*message*/) { return value(); }
};

template <>
struct DataType<sweep_guard_ros::FollowJointTrajectoryActionGoal> {
  static const char* value() { return "control_msgs/FollowJointTrajectoryActionGoal"; }
  static const char* value(const sweep_guard_ros::FollowJointTrajectoryActionGoal& /*message*/) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<sweep_guard_ros::JointTolerance> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.name);
    stream.next(message.position);
    stream.next(message.velocity);
    stream.next(message.acceleration);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

template <>
struct Serializer<sweep_guard_ros::FollowJointTrajectoryActionGoal> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.goal_id);
    stream.next(message.trajectory);
    stream.next(message.path_tolerance);
    stream.next(message.goal_tolerance);
    stream.next(message.goal_time_tolerance);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
