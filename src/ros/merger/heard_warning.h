#pragma once

#include <ros/node_handle.h>
#include <sweep_guard/Warning.h>

#include <functional>
#include <string>

#include "monitor/warning_merger.h"
#include "ros/connection/bounded.h"

namespace sweep_guard_ros {

/// Returns a warning that was received now.
/// @throws sweep_guard_core::InvalidInput if its level is unknown
sweep_guard_core::HeardWarning heardFrom(const sweep_guard::Warning& message);

/// Subscribes to the warning of a guard.
/// @param hear    may throw sweep_guard_core::InvalidInput: the message is refused
/// @param refuse  takes why a message is refused: also while several nodes publish the topic
BoundedSubscriber subscribeToWarning(const ros::NodeHandle& node, const std::string& topic,
                                     std::function<void(const sweep_guard::Warning&)> hear,
                                     std::function<void(const std::string&)> refuse);

}  // namespace sweep_guard_ros
