#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ros/connection/xml_rpc_call.h"

namespace sweep_guard_ros {

using Publishers = std::set<std::string>;  ///< addresses of nodes, http://HOST:PORT
using PublishersOfTopics = std::map<std::string, Publishers>;

std::string ownUri();  ///< address of this process, as other nodes call it

/// The publishers that a process is connected to, by topic.
struct PublisherLinks {
  PublishersOfTopics all;
  PublishersOfTopics down;  ///< of these, those to which there is no connection at the moment
};

/// Asks this process, as another node would, which publishers it is connected to.
/// @returns empty optional: no answer
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
std::optional<PublisherLinks> publisherLinks(const XmlRpcCall& call);
/// Returns PublisherLinks::all.
std::optional<PublishersOfTopics> connectedPublishers(const XmlRpcCall& call);

/// Asks the master for the nodes that publish a topic.
/// @returns empty optional: no answer
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
std::optional<std::vector<std::string>> registeredPublishers(const XmlRpcCall& call, const std::string& topic);

/// Returns the publishers of a topic that the master knows and this process is not connected to.
/// @returns empty optional: no answer
/// @throws XmlRpc::XmlRpcException if an answer cannot be read
std::optional<Publishers> unconnectedPublishers(const XmlRpcCall& call, const std::string& topic);

/// Connects a topic to some publishers and disconnects it from others; all other connections stay. roscpp takes a list
/// of publishers as complete, so the connections are read immediately before. A publisher that another node announces
/// in between, and that is connected by then, is disconnected again.
/// @returns false: no answer, or not all could be connected
/// @throws XmlRpc::XmlRpcException if the answer cannot be read
bool updatePublishers(const XmlRpcCall& call, const std::string& topic, const Publishers& added,
                      const Publishers& removed = {});

}  // namespace sweep_guard_ros
