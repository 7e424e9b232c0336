#include "guard_process.h"

#include <ros/master.h>
#include <ros/network.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sweep_guard_ros {
namespace {

double statusMegabytes(pid_t pid, const std::string& key) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  }
  return 0.0;
}

bool askNode(const std::string& node, const char* method, const XmlRpc::XmlRpcValue& request,
             XmlRpc::XmlRpcValue& response) {
  XmlRpc::XmlRpcValue lookup;
  lookup[0] = "sweep_guard_test";
  lookup[1] = node;
  XmlRpc::XmlRpcValue uri;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", lookup, response, uri, /*wait_for_master=*/false)) return false;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  return client.execute(method, request, response) && response.size() >= 3;
}

}  // namespace

std::vector<std::string> program(const std::string& name, std::vector<std::string> arguments) {
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  arguments.insert(arguments.begin(), here / name);
  return arguments;
}

const XmlRpcCall& xmlRpc() {
  static const std::atomic<bool> never = false;
  static const XmlRpcCall call(std::chrono::seconds(5), never);
  return call;
}

pid_t pidOf(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  request[0] = "sweep_guard_test";
  XmlRpc::XmlRpcValue response;
  return askNode(node, "getPid", request, response) ? static_cast<int>(response[2]) : 0;
}

std::uint16_t guardPort() {
  XmlRpc::XmlRpcValue request;
  request[0] = "sweep_guard_test";
  request[1] = "/sweep_guard/warning";
  request[2][0][0] = "TCPROS";
  XmlRpc::XmlRpcValue response;
  if (!askNode("/sweep_guard", "requestTopic", request, response))
    throw std::runtime_error("the guard does not answer");
  return static_cast<std::uint16_t>(static_cast<int>(response[2][2]));
}

double residentMegabytes(pid_t pid) { return statusMegabytes(pid, "VmRSS"); }

double peakMegabytes(pid_t pid) { return statusMegabytes(pid, "VmHWM"); }

double processorSeconds(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

GuardLog::GuardLog() {
  subscriber_ = node_.subscribe<rosgraph_msgs::Log>("/rosout", 1000, [this](const rosgraph_msgs::Log::ConstPtr& line) {
    if (line->name != "/sweep_guard") return;
    const std::lock_guard lock(mutex_);
    lines_.push_back(*line);
    changed_.notify_all();
  });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (subscriber_.getNumPublishers() < 2) {  // this node and the guard
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("the guard's log is not connected");
    ros::WallDuration(0.001).sleep();
  }
}

std::vector<rosgraph_msgs::Log> GuardLog::lines() const {
  const std::lock_guard lock(mutex_);
  return lines_;
}

void GuardLog::await(const std::string& part) const {
  const auto has_it = [&] {
    return std::any_of(lines_.begin(), lines_.end(),
                       [&](const auto& line) { return line.msg.find(part) != std::string::npos; });
  };
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, std::chrono::seconds(20), has_it)) throw std::runtime_error("not logged: " + part);
}

}  // namespace sweep_guard_ros
