#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <string>
#include <vector>

namespace sweep_guard_recording {

/// Which topics of a bag there are to choose from.
struct TopicChoice {
  std::vector<std::string> types;  ///< of messages, as in geometry_msgs/PoseStamped
  std::string what;                ///< the types in words
  std::string how;                 ///< how one is chosen, in words
};

/// Returns the topic of a bag that was asked for, or else the only one.
/// @param requested  empty: the only one
/// @throws sweep_guard_core::InvalidInput if the topic is missing or there are several to choose from (the message lists
///     them)
std::string chooseTopic(const rosbag::Bag& bag, const std::string& requested, const TopicChoice& choice);

/// Opens a bag and has it read.
/// @throws sweep_guard_core::InvalidInput, which begins with the path, if it is no bag or a broken one, or if `read` throws
///     one
void openBag(const std::string& path, const std::function<void(const rosbag::Bag&)>& read);

/// Has each message on a topic read, in the order of the bag.
/// @throws sweep_guard_core::InvalidInput, which begins with topic and number of the message, if `read` throws one; or if
///     there is no message
void forEachMessage(const rosbag::Bag& bag, const std::string& topic,
                    const std::function<void(const rosbag::MessageInstance&)>& read);

}  // namespace sweep_guard_recording
