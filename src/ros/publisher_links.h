#pragma once

#include <map>
#include <set>
#include <string>

#include "ros/xml_rpc_call.h"

namespace sweep_guard_ros {

using Publishers = std::set<std::string>;  ///< addresses of nodes, http://HOST:PORT

std::string ownUri();  ///< address of this process, as other nodes call it

/// Asks this process, as another node would, which publishers it is connected to.
/// @returns publishers by topic; empty optional: no answer
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
std::optional<std::map<std::string, Publishers>> connectedPublishers(const XmlRpcCall& call);

/// Registers this process at the master as a subscriber, as it may be already, and asks for the publishers of a topic.
/// @returns empty optional: no answer
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
std::optional<Publishers> registerSubscriber(const XmlRpcCall& call, const std::string& topic, const std::string& type);

/// Connects a topic to some publishers and disconnects it from others; all other connections stay. roscpp takes a list
/// of publishers as complete, so the connections are read immediately before. A publisher that another node announces
/// in between, and that is connected by then, is disconnected again.
/// @returns false: no answer, or not all could be connected
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
bool updatePublishers(const XmlRpcCall& call, const std::string& topic, const Publishers& added,
                      const Publishers& removed = {});

}  // namespace sweep_guard_ros
