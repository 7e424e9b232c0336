#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>

#include <functional>
#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// Describes the topics of a bag among which one is chosen.
struct TopicChoice {
  std::vector<std::string> types;                        ///< of messages, as in geometry_msgs/PoseStamped
  std::string what;                                      ///< the types in words
  std::string how;                                       ///< how one is chosen, in words
  std::function<bool(const std::string& topic)> fits{};  ///< of those with these types; empty: each does
};

/// Returns the topic of a bag that was asked for, or else the only one.
/// @param requested  empty: the only one
/// @throws sweep_guard_core::InvalidInput if the topic is missing or there are several to choose from (the message lists
///     them)
std::string chooseTopic(const rosbag::Bag& bag, const std::string& requested, const TopicChoice& choice);

/// Opens a bag and passes it to a function.
/// @throws sweep_guard_core::InvalidInput, which begins with the path, if it is no bag or a broken one, or if `read` throws
///     one
void openBag(const std::string& path, const std::function<void(const rosbag::Bag&)>& read);

/// Passes each message on a topic to a function, in the order of the bag.
/// @throws sweep_guard_core::InvalidInput, which begins with topic and number of the message, if `read` throws one; or if
///     there is no message
void forEachMessage(const rosbag::Bag& bag, const std::string& topic,
                    const std::function<void(const rosbag::MessageInstance&)>& read);

/// Returns whether a file begins like a rosbag; false if it cannot be read.
bool isBag(const std::string& path);

/// Reads a recorded motion from one topic of a rosbag: geometry_msgs/PoseStamped or TransformStamped. Takes the stamps
/// from the headers and keeps equal ones.
/// @param topic  empty: the only topic of these types
/// @return the poses in the order of the bag, at least one, with orthonormal rotations
/// @throws sweep_guard_core::InvalidInput if the file cannot be read or is no bag, if the topic is missing or there are
///     several to choose from (the message lists them), if fromMsg() refuses a pose, a stamp is earlier than the
///     previous one, or the frames change
std::vector<sweep_guard_core::StampedPose> readBag(const std::string& path, const std::string& topic);

/// Passes each sensor_msgs/JointState on one topic of a rosbag to a function, in the order of the bag.
/// @param topic  empty: the only topic of this type
/// @param read   takes the name of the node that published the message, and the message
/// @throws sweep_guard_core::InvalidInput as readBag() does, or naming the message if `read` throws one
void readJointBag(const std::string& path, const std::string& topic,
                  const std::function<void(const std::string& publisher, const sensor_msgs::JointState&)>& read);

}  // namespace sweep_guard_recording
