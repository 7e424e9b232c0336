#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace sweep_guard_ros {

/// A list is told as text: [x, y, z].
using ParameterValue = std::variant<bool, int, double, std::string>;

/// For people.
std::string shown(const ParameterValue& value);

/// What one parameter is, and what it may be.
struct ParameterInfo {
  std::string key;
  ParameterValue value;  ///< as set, or what it falls back to
  ParameterValue fallback;
  double lowest = -std::numeric_limits<double>::infinity();  ///< of a number, where no other parameter narrows it
  double highest = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< of a text that has to be one of them
  std::string wanted;                ///< unit and range in words
};

/// Reads the private parameters of a node, strictly: each function returns what is set for the key, or the fallback
/// where nothing is set. roscpp's own reading falls back in silence where the type is wrong. All throw
/// sweep_guard::InvalidInput naming key, value and range if the value has another type, is NaN or is out of range.
class ParameterReader {
 public:
  struct Range {
    double lowest;
    double highest;
    const char* unit = "";
  };

  /// A narrower range that hangs on another parameter.
  struct Bound {
    Range range;
    const char* note;  ///< what it hangs on, for the message
  };

  /// By key; empty: nothing is set.
  using Settings = std::map<std::string, std::optional<XmlRpc::XmlRpcValue>>;

  /// @param known  settings that are not asked of the parameter server
  explicit ParameterReader(const ros::NodeHandle& private_node, Settings known = {})
      : node_(private_node), settings_(std::move(known)) {}

  /// An integer is a number too. The fallback is checked as well.
  double number(const std::string& key, double fallback, const Range& range, const std::optional<Bound>& bound = {});
  int integer(const std::string& key, int fallback, int lowest, int highest);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string name(const std::string& key, const std::string& fallback);  ///< text, not empty
  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices);
  /// As many integers as the fallback has: a list of them, or the text `1, 2` or `[1, 2]`, as of the others below.
  std::vector<int> integers(const std::string& key, const std::vector<int>& fallback, int lowest, int highest);
  /// Some of the choices, or none: a list without the rest, [] where nothing is set.
  std::vector<std::string> selection(const std::string& key, const std::vector<std::string>& choices);
  std::vector<std::string> texts(const std::string& key);  ///< [] where nothing is set
  /// A group of numbers by their names, none where nothing is set. Any finite number is accepted.
  std::map<std::string, double> numbers(const std::string& key);
  /// Text of a parameter of any namespace from the node's own upwards, or an absolute name; empty: there is none.
  std::string textAbove(const std::string& name);
  /// Refuses the parameter if it is set at all. @param instead  what to do
  void refuseIfSet(const std::string& key, const std::string& instead);
  Eigen::Vector3d position(const std::string& key, const Eigen::Vector3d& fallback);  ///< [x, y, z] within +-1e6 m

  /// All that has been asked for, of the server or known before.
  const Settings& settings() const { return settings_; }
  /// Of all flags, integers, numbers, choices and lists of a kind that were read, in that order.
  const std::vector<ParameterInfo>& described() const { return described_; }

  /// Warns of every private parameter that has not been asked for: a key that is misspelt would have no effect.
  /// @throws sweep_guard::InvalidInput if a value stands where a group of parameters belongs
  void warnOfUnread() const;

 private:
  bool isGroup(const std::string& key) const;
  bool get(const std::string& key, XmlRpc::XmlRpcValue& value);
  bool getList(const std::string& key, const std::string& wanted, XmlRpc::XmlRpcValue& list);
  [[noreturn]] void refuse(const std::string& key, const XmlRpc::XmlRpcValue& value, const std::string& wanted) const;

  ros::NodeHandle node_;
  Settings settings_;
  std::set<std::string> read_;
  std::vector<ParameterInfo> described_;
};

}  // namespace sweep_guard_ros
