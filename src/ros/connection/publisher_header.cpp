#include "ros/connection/publisher_header.h"

#include <ros/header.h>
#include <ros/this_node.h>

#include <boost/asio/ip/tcp.hpp>
#include <cstring>
#include <vector>

#include "ros/connection/publisher_links.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kMaxHeader = 1U << 20U;  // [bytes]

// Both directions begin with the length of the header.
std::optional<ros::M_string> exchangeHeaders(const std::string& host, int port, const ros::M_string& asked) {
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(kCallTimeout);
  stream.connect(host, std::to_string(port));
  boost::shared_array<std::uint8_t> sent;
  std::uint32_t length = 0;
  ros::Header::write(asked, sent, length);
  stream.write(reinterpret_cast<const char*>(&length), sizeof length);
  stream.write(reinterpret_cast<const char*>(sent.get()), length);
  stream.flush();
  stream.read(reinterpret_cast<char*>(&length), sizeof length);
  if (!stream || length > kMaxHeader) return std::nullopt;
  std::vector<std::uint8_t> received(length);
  stream.read(reinterpret_cast<char*>(received.data()), length);
  ros::Header header;
  std::string error;
  if (!stream || !header.parse(received.data(), length, error)) return std::nullopt;
  return *header.getValues();
}

}  // namespace

std::optional<ros::M_string> publisherHeader(const XmlRpcCall& call, const std::string& topic,
                                             const std::string& publisher) {
  XmlRpc::XmlRpcValue protocols;
  protocols[0][0] = "TCPROS";
  const auto answer = call.call(publisher, "requestTopic", {XmlRpc::XmlRpcValue(topic), protocols});
  if (!answer || !answer->success) return std::nullopt;
  const std::string& host = answer->value[1];
  const int port = answer->value[2];
  return exchangeHeaders(host, port,
                         {{"callerid", ros::this_node::getName()}, {"topic", topic}, {"type", "*"}, {"md5sum", "*"}});
}

std::optional<ros::M_string> publisherHeader(const XmlRpcCall& call, const std::string& topic) {
  const auto publishers = connectedPublishers(call);
  if (!publishers || publishers->count(topic) == 0) return std::nullopt;
  for (const std::string& publisher : publishers->at(topic)) {
    if (auto header = publisherHeader(call, topic, publisher)) return header;
  }
  return std::nullopt;
}

}  // namespace sweep_guard_ros
