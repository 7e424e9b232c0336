#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rosgraph_msgs/Log.h>
#include <sys/types.h>

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "ros/connection/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Returns the command line of a program of this package.
std::vector<std::string> program(const std::string& name, std::vector<std::string> arguments = {});
inline std::vector<std::string> guardWith(std::vector<std::string> arguments) {
  return program("sweep_guard_node", std::move(arguments));
}
const XmlRpcCall& xmlRpc();  ///< waits for 5 s

pid_t pidOf(const std::string& node);  ///< 0: it does not answer
inline pid_t guardPid() { return pidOf("/sweep_guard"); }
std::uint16_t guardPort();  ///< TCP port of its topics

/// What the kernel knows about a process.
double residentMegabytes(pid_t pid);
double peakMegabytes(pid_t pid);  ///< largest resident memory since the process began
double processorSeconds(pid_t pid);

constexpr double kMaxGrowth = 64.0;  ///< [MB] by which the memory of a guard may grow, whatever is sent

/// Keeps what the guard logs.
class GuardLog {
 public:
  GuardLog();  ///< returns when it is connected
  std::vector<rosgraph_msgs::Log> lines() const;
  void await(const std::string& part) const;  ///< waits for a line with it @throws std::runtime_error after 20 s

 private:
  ros::NodeHandle node_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<rosgraph_msgs::Log> lines_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_ros
