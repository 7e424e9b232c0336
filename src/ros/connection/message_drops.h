#pragma once

#include <optional>
#include <string>

#include "ros/connection/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Asks this process, as another node would, how many messages of a topic it has dropped unread because more of them
/// waited than its queue holds. roscpp tells nobody else. A publisher that goes takes its number along.
/// @returns empty optional: no answer
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
std::optional<int> messageDrops(const XmlRpcCall& call, const std::string& topic);

}  // namespace sweep_guard_ros
