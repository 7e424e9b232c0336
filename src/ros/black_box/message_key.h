#pragma once

#include <string>

#include "ros/black_box/recorded_topics.h"
#include "ros/connection/wire.h"

namespace sweep_guard_ros {

/// Returns the key of a message in a sweep_guard_core::MessageWindow; empty if none of its kind is kept, or if the message
/// cannot be read.
/// @param publisher  name of the node that sent it
std::string messageKey(const RecordedTopic& topic, const std::string& publisher, Wire message);

}  // namespace sweep_guard_ros
