#pragma once

#include <set>
#include <string>

#include "ros/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Asks the master which nodes publish a topic.
/// @param topic  resolved name
/// @returns names of the nodes; empty optional: no answer
std::optional<std::set<std::string>> registeredPublishers(const XmlRpcCall& call, const std::string& topic);

}  // namespace sweep_guard_ros
