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

/// A list is held as text: [x, y, z].
using ParameterValue = std::variant<bool, int, double, std::string>;

/// Returns the value as text for people.
std::string shown(const ParameterValue& value);

/// Describes one parameter. doc/interface.md and config/sweep_guard.yaml are written from this.
struct ParameterInfo {
  std::string key;
  ParameterValue value;  ///< as set, or the fallback
  ParameterValue fallback;
  double lowest = -std::numeric_limits<double>::infinity();  ///< of a number, where no other parameter narrows it
  double highest = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< the texts allowed; empty: any
  std::string wanted;                ///< unit, type and range in words
  std::string effect;                ///< sentences for users
};

/// Reads the private parameters of a node, strictly: each function returns the value set for the key, or the fallback
/// where nothing is set. (roscpp returns the fallback without a word where the type is wrong.) All throw
/// sweep_guard_core::InvalidInput naming key, value and range if the value has another type, is NaN or is out of range.
/// `effect` goes into described(): what the parameter does, in sentences for users.
class ParameterReader {
 public:
  struct Range {
    double lowest;
    double highest;
    const char* unit = "";
  };

  /// A narrower range that depends on another parameter.
  struct Bound {
    Range range;
    const char* note;  ///< names the other parameter in the message
  };

  /// By key; empty: nothing is set.
  using Settings = std::map<std::string, std::optional<XmlRpc::XmlRpcValue>>;

  /// @param known  settings that are not asked of the parameter server
  explicit ParameterReader(const ros::NodeHandle& private_node, Settings known = {})
      : node_(private_node), settings_(std::move(known)) {}

  /// Accepts an integer, too, and checks the fallback as well.
  double number(const std::string& key, double fallback, const Range& range, const std::string& effect = "",
                const std::optional<Bound>& bound = {});
  int integer(const std::string& key, int fallback, int lowest, int highest, const std::string& effect = "");
  bool flag(const std::string& key, bool fallback, const std::string& effect = "");
  std::string text(const std::string& key, const std::string& fallback);
  /// Reads a text that is not empty.
  std::string name(const std::string& key, const std::string& fallback, const std::string& effect = "");
  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices,
                     const std::string& effect = "");
  /// Reads as many integers as the fallback has. All lists may be given as text: `1, 2` or `[1, 2]`.
  std::vector<int> integers(const std::string& key, const std::vector<int>& fallback, int lowest, int highest,
                            const std::string& effect = "");
  /// Reads a list of some of the choices; [] where nothing is set.
  std::vector<std::string> selection(const std::string& key, const std::vector<std::string>& choices,
                                     const std::string& effect = "");
  /// Reads a list of texts that are not empty; [] where nothing is set.
  std::vector<std::string> texts(const std::string& key, const std::string& effect = "");
  /// Reads a group of finite numbers by their names; empty where nothing is set.
  std::map<std::string, double> numbers(const std::string& key, const std::string& effect = "");
  /// Reads the text of a parameter in the node's namespace or one above it, or under an absolute name; "" if it is
  /// unset.
  std::string textAbove(const std::string& name);
  /// Refuses the parameter if it is set at all. @param instead  tells the user what to do
  void refuseIfSet(const std::string& key, const std::string& instead);
  Eigen::Vector3d position(const std::string& key, const Eigen::Vector3d& fallback);  ///< [x, y, z] within +-1e6 m

  /// Returns every parameter that was read, from the server or known before.
  const Settings& settings() const { return settings_; }
  /// Returns what is known of each parameter that was read, but for text() and position(), in the order of reading.
  const std::vector<ParameterInfo>& described() const { return described_; }

  /// Warns of every private parameter that was not read, because a misspelt key would have no effect.
  /// @throws sweep_guard_core::InvalidInput if a value stands where a group of parameters belongs
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
