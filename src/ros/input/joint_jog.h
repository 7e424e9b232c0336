#pragma once

#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

#include <boost/shared_ptr.hpp>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// The message control_msgs/JointJog, which Debian does not package.
struct JointJog {
  std_msgs::Header header;
  std::vector<std::string> joint_names;
  std::vector<double> displacements;  ///< [rad or m]
  std::vector<double> velocities;     ///< [rad/s or m/s]
  double duration = 0.0;              ///< [s]

  using ConstPtr = boost::shared_ptr<const JointJog>;
};

}  // namespace sweep_guard_ros

namespace ros {
namespace message_traits {

template <>
struct HasHeader<sweep_guard_ros::JointJog> : TrueType {};
template <>
struct HasHeader<const sweep_guard_ros::JointJog> : TrueType {};

template <>
struct MD5Sum<sweep_guard_ros::JointJog> {
  static const char* value() { return "1685da700c8c2e1254afc92a5fb89c96"; }
  static const char* value(const sweep_guard_ros::JointJog& /*message*/) { return value(); }
  static constexpr std::uint64_t static_value1 = 0x1685da700c8c2e12;
  static constexpr std::uint64_t static_value2 = 0x54afc92a5fb89c96;
};

template <>
struct DataType<sweep_guard_ros::JointJog> {
  static const char* value() { return "control_msgs/JointJog"; }
  static const char* value(const sweep_guard_ros::JointJog& /*message*/) { return value(); }
};

template <>
struct Definition<sweep_guard_ros::JointJog> {
  static const char* value() {
    return "Header header\n"
           "string[] joint_names\n"
           "float64[] displacements\n"
           "float64[] velocities\n"
           "float64 duration\n"
           "================================================================================\n"
           "MSG: std_msgs/Header\n"
           "uint32 seq\n"
           "time stamp\n"
           "string frame_id\n";
  }
  static const char* value(const sweep_guard_ros::JointJog& /*message*/) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<sweep_guard_ros::JointJog> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.joint_names);
    stream.next(message.displacements);
    stream.next(message.velocities);
    stream.next(message.duration);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
