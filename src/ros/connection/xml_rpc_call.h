#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace sweep_guard_ros {

constexpr std::chrono::milliseconds kCallTimeout{500};  ///< for a call that is repeated if it fails

/// Calls the ROS master, or another node (wiki.ros.org/ROS/Master_API, Slave_API). Unlike roscpp's own calls it gives up
/// after a while: a master that is frozen or cut off never answers, and the name of its machine may not be resolved.
class XmlRpcCall {
 public:
  /// @param longest   time until an answer is no longer expected
  /// @param stopping  ends a call soon once it is true; must outlive the calls
  XmlRpcCall(std::chrono::milliseconds longest, const std::atomic<bool>& stopping)
      : longest_(longest), stopping_(stopping) {}

  struct Answer {
    bool success;  ///< false: the call was refused
    XmlRpc::XmlRpcValue value;
  };

  /// @param uri        http://HOST:PORT of the master or node
  /// @param arguments  those after the caller's name, which is this node's
  /// @returns empty if there was no answer
  std::optional<Answer> call(const std::string& uri, const std::string& function,
                             const std::vector<XmlRpc::XmlRpcValue>& arguments) const;

 private:
  const std::chrono::milliseconds longest_;
  const std::atomic<bool>& stopping_;
};

}  // namespace sweep_guard_ros
