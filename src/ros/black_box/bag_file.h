#pragma once

#include <ros/message_event.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "black_box/message_window.h"

namespace sweep_guard_ros {

/// A message as it was received, and the name of its topic in a bag.
struct HeardMessage {
  std::string topic;
  topic_tools::ShapeShifter::ConstPtr message;
  boost::shared_ptr<ros::M_string> connection;  ///< header: who sent it, on which topic, whether it was latched
};

using HeardMessages = std::vector<sweep_guard_core::WindowMessage<HeardMessage>>;

/// Returns an upper estimate of the size of a bag of these messages [bytes].
std::uintmax_t bagSize(const HeardMessages& messages);

/// Writes a bag and reads its index again.
/// @throws sweep_guard_core::DeviceError with the reason if it is not whole
void writeBag(const std::filesystem::path& file, const HeardMessages& messages);

}  // namespace sweep_guard_ros
