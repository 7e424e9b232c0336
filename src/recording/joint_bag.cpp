#include "recording/joint_bag.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;

namespace {

std::optional<std::vector<double>> positionsOf(const sensor_msgs::JointState& joints,
                                               const std::vector<std::string>& names) {
  std::vector<double> positions;
  for (const std::string& name : names) {
    const auto found = std::find(joints.name.begin(), joints.name.end(), name);
    const auto index = static_cast<size_t>(found - joints.name.begin());
    if (index >= joints.position.size()) return std::nullopt;
    if (!std::isfinite(joints.position[index])) throw InvalidInput("a position of joint '" + name + "' is not finite");
    positions.push_back(joints.position[index]);
  }
  return positions;
}

std::vector<RecordedJoints> read(const rosbag::Bag& bag, const std::string& topic,
                                 const std::vector<std::string>& names) {
  std::vector<RecordedJoints> states;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TypeQuery("sensor_msgs/JointState"))) {
    if (!topic.empty() && message.getTopic() != topic) continue;
    const auto joints = message.instantiate<sensor_msgs::JointState>();
    const auto positions = joints ? positionsOf(*joints, names) : std::nullopt;
    if (!positions) continue;
    const sweep_guard_core::Time stamp = sweep_guard_ros::fromMsg(joints->header.stamp);
    if (states.empty() || stamp > states.back().stamp) states.push_back({stamp, *positions});
  }
  if (states.empty()) throw InvalidInput("no JointState has all joints that move the links; record them on one topic");
  return states;
}

}  // namespace

std::vector<RecordedJoints> readJointBag(const std::string& path, const std::string& topic,
                                         const std::vector<std::string>& names) {
  try {
    return read(rosbag::Bag(path), topic, names);
  } catch (const std::exception& error) {  // of rosbag or ROS, too
    throw InvalidInput(path + ": " + error.what());
  }
}

}  // namespace sweep_guard_recording
