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
/// The same, of one publisher, connected or not.
std::optional<ros::M_string> publisherHeader(const XmlRpcCall& call, const std::string& topic,
                                             const std::string& publisher);
/// Returns the header of a publisher that the master knows and that is not connected, because its messages have another
/// definition: roscpp keeps a topic to that of the first publisher. Its `callerid` is the node.
/// @param md5  of the definition of those that are connected
std::optional<ros::M_string> unconnectedHeader(const XmlRpcCall& call, const std::string& topic,
                                               const std::string& md5);

}  // namespace sweep_guard_ros
