#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <string>

namespace sweep_guard_simulation {

/// Private parameters of a node. Each function returns the value set for `key`, or the fallback where none is set.
/// All throw sweep_guard::InvalidInput with key, value and range if the value has another type, is NaN or out of range.
class Parameters {
 public:
  explicit Parameters(const ros::NodeHandle& node) : node_(node) {}

  double number(const std::string& key, double fallback, double min, double max) const;
  int integer(const std::string& key, int fallback, int min, int max) const;
  bool boolean(const std::string& key, bool fallback) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  std::string name(const std::string& key, const std::string& fallback) const;  ///< text, not empty
  Eigen::Vector3d position(const std::string& key,
                           const Eigen::Vector3d& fallback) const;  ///< [x, y, z], within +-1e6 m

 private:
  ros::NodeHandle node_;
};

}  // namespace sweep_guard_simulation
