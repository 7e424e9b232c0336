#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <atomic>
#include <optional>
#include <string>

#include "ros/connection/xml_rpc_call.h"

namespace sweep_guard_ros {

/// Returns a value as YAML that rosparam loads: a group as an indented block, all else in one line.
std::string toYaml(const XmlRpc::XmlRpcValue& value);

/// The parameters of a guard on the parameter server. One thread.
class GuardConfig {
 public:
  /// @param guard     name of its node
  /// @param stopping  ends a call to the master soon once it is true; must outlive this
  GuardConfig(std::string guard, const std::atomic<bool>& stopping)
      : guard_(std::move(guard)), call_(kCallTimeout, stopping) {}

  /// Asks the master. If it does not answer, its previous answer stays.
  void refresh();

  /// Returns a file of parameters for a guard: its own, and the robot description that it finds.
  std::string yaml() const;

 private:
  std::optional<XmlRpc::XmlRpcValue> get(const std::string& name) const;
  std::optional<XmlRpc::XmlRpcValue> robotDescription(const XmlRpc::XmlRpcValue& parameters) const;

  const std::string guard_;
  const XmlRpcCall call_;
  XmlRpc::XmlRpcValue parameters_;
};

}  // namespace sweep_guard_ros
