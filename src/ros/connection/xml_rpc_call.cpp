#include "ros/connection/xml_rpc_call.h"

#include <ros/network.h>
#include <ros/this_node.h>

#include <cstdint>
#include <thread>

#include "ros/connection/host_address.h"

namespace sweep_guard_ros {
namespace {

constexpr double kStep = 0.02;  // [s]
constexpr auto kResolverStep = std::chrono::milliseconds(5);

}  // namespace

std::optional<XmlRpcCall::Answer> XmlRpcCall::call(const std::string& uri, const std::string& function,
                                                   const std::vector<XmlRpc::XmlRpcValue>& arguments) const {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return std::nullopt;
  XmlRpc::XmlRpcValue all;
  all[0] = ros::this_node::getName();
  for (const XmlRpc::XmlRpcValue& argument : arguments) all[all.size()] = argument;

  const auto deadline = std::chrono::steady_clock::now() + longest_;
  std::optional<std::string> address;
  while (!(address = hostAddress(host))) {
    if (stopping_ || std::chrono::steady_clock::now() >= deadline) return std::nullopt;
    std::this_thread::sleep_for(kResolverStep);
  }
  XmlRpc::XmlRpcClient client(address->c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue answer;
  if (!client.executeNonBlock(function.c_str(), all)) return std::nullopt;
  while (!client.executeCheckDone(answer)) {
    if (stopping_ || std::chrono::steady_clock::now() >= deadline) return std::nullopt;
    client._disp.work(kStep);
  }
  const bool is_answer = !client.isFault() && answer.getType() == XmlRpc::XmlRpcValue::TypeArray && answer.size() == 3;
  if (!is_answer || answer[0].getType() != XmlRpc::XmlRpcValue::TypeInt) return std::nullopt;
  return Answer{static_cast<int>(answer[0]) == 1, answer[2]};
}

}  // namespace sweep_guard_ros
