#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// Reads the private parameters of a node, strictly: each function returns what is set for the key, or the fallback
/// where nothing is set. roscpp's own reading falls back in silence where the type is wrong. All throw
/// sweep_guard::InvalidInput naming key, value and range if the value has another type, is NaN or is out of range.
class ParameterReader {
 public:
  struct Range {
    double lowest;
    double highest;
  };

  explicit ParameterReader(const ros::NodeHandle& private_node) : node_(private_node) {}

  /// An integer is a number too. The fallback is checked as well: a range may hang on another parameter.
  /// @param note  what the range hangs on, for the message
  double number(const std::string& key, double fallback, const Range& range, const std::string& note = "");
  int integer(const std::string& key, int fallback, int lowest, int highest);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string name(const std::string& key, const std::string& fallback);  ///< text, not empty
  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices);
  /// As many integers as the fallback has.
  std::vector<int> integers(const std::string& key, const std::vector<int>& fallback, int lowest, int highest);
  /// Some of the choices, or none: a list without the rest, [] where nothing is set.
  std::vector<std::string> selection(const std::string& key, const std::vector<std::string>& choices);
  std::vector<std::string> texts(const std::string& key);  ///< a list of them, or `a,b`; [] where nothing is set
  /// A group of numbers by their names, none where nothing is set. Any finite number is accepted.
  std::map<std::string, double> numbers(const std::string& key);
  /// Text of a parameter of any namespace from the node's own upwards, or an absolute name; empty: there is none.
  std::string textAbove(const std::string& name);
  /// Refuses the parameter if it is set at all. @param instead  what to do
  void refuseIfSet(const std::string& key, const std::string& instead);
  Eigen::Vector3d position(const std::string& key, const Eigen::Vector3d& fallback);  ///< [x, y, z] within +-1e6 m

  /// Warns of every private parameter that has not been asked for: a key that is misspelt would have no effect.
  /// @throws sweep_guard::InvalidInput if a value stands where a group of parameters belongs
  void warnOfUnread() const;

 private:
  bool isGroup(const std::string& key) const;
  bool get(const std::string& key, XmlRpc::XmlRpcValue& value);
  [[noreturn]] void refuse(const std::string& key, const XmlRpc::XmlRpcValue& value, const std::string& wanted) const;

  ros::NodeHandle node_;
  std::set<std::string> read_;
};

}  // namespace sweep_guard_ros
