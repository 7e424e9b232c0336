#pragma once

#include <ros/datatypes.h>

#include <optional>
#include <string>

#include "ros/connection/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Asks a publisher of a topic, as a new subscriber would, what it sends: type, md5sum and message_definition
/// (wiki.ros.org/ROS/Connection Header). A publisher that has not sent anything yet has told it to nobody here.
/// @param topic  resolved, which this process has subscribed to
/// @returns empty if there is no publisher, or none that answers
/// @throws XmlRpc::XmlRpcException if an answer cannot be read
std::optional<ros::M_string> publisherHeader(const XmlRpcCall& call, const std::string& topic);
/// The same, of one publisher, connected or not. For a moment it has a subscriber more.
std::optional<ros::M_string> publisherHeader(const XmlRpcCall& call, const std::string& topic,
                                             const std::string& publisher);

}  // namespace sweep_guard_ros
