#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace sweep_guard_ros {

/// Holds a value. A list is text: [x, y, z]. So is a group, {a: x, b: y}, and a list of groups.
using ParameterValue = std::variant<bool, int, double, std::string>;

/// Returns the value as text for people.
std::string shown(const ParameterValue& value);

/// Describes one parameter. doc/interface.md and config/sweep_guard.yaml are generated from these.
struct ParameterInfo {
  std::string key;
  ParameterValue value;  ///< set value, or the fallback
  ParameterValue fallback;
  double lowest = -std::numeric_limits<double>::infinity();  ///< bound of a number; a `narrowed` range may be closer
  double highest = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< allowed texts of choice(); empty: any
  std::string wanted;                ///< type, unit and range, as text
  std::string effect;                ///< sentences for users
  bool live = false;                 ///< may change while the node runs
};

/// Range of a number, ends included.
struct ParameterRange {
  double lowest;
  double highest;
  const char* unit = "";  ///< for the description only, without brackets; not null
  const char* note = "";  ///< of a narrowed range: words for the error text that name the other parameter; not null
};

/// A number or a flag that a group may have.
struct GroupEntry {
  std::string name;
  std::optional<ParameterRange> range = {};  ///< empty: a flag
};

/// Reads the private parameters of a node. Each function returns the value that is set, or the fallback if none is, and
/// throws sweep_guard_core::InvalidInput with key, value and range if the value has another type, is NaN or is out of
/// range. (roscpp silently returns the fallback if the type is wrong.) Both ends of a range are allowed. `effect`
/// describes the parameter to users. Not thread-safe.
class ParameterReader {
 public:
  using Range = ParameterRange;

  /// Holds values by key; empty: not set.
  using Settings = std::map<std::string, std::optional<XmlRpc::XmlRpcValue>>;

  /// @param known  settings that are taken instead of the parameter server's; an empty one counts as not set
  explicit ParameterReader(const ros::NodeHandle& private_node, Settings known = {})
      : node_(private_node), settings_(std::move(known)) {}

  /// Describes the parameter that is read next as live: it may change while the node runs. Tools, topics and devices may not.
  ParameterReader& live() {
    next_is_live_ = true;
    return *this;
  }

  /// Reads a number; accepts an integer. Checks the fallback, too, as do integer(), name() and choice().
  /// @param narrowed  by another parameter: checked in place of the wider range
  double number(const std::string& key, double fallback, const Range& range, const std::string& effect = "",
                const std::optional<Range>& narrowed = {});
  int integer(const std::string& key, int fallback, int lowest, int highest, const std::string& effect = "");
  bool flag(const std::string& key, bool fallback, const std::string& effect = "");
  /// Reads a text, which may be empty.
  std::string text(const std::string& key, const std::string& fallback);
  /// Reads a text that is not empty.
  std::string name(const std::string& key, const std::string& fallback, const std::string& effect = "");
  /// Reads a text; "" if not set.
  std::string optionalName(const std::string& key, const std::string& effect);
  /// Reads the path of a file; "" if not set.
  std::string path(const std::string& key, const std::string& effect);
  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices,
                     const std::string& effect = "");
  /// Reads as many integers as the fallback has. Any list but a position() may be text: `1, 2` or `[1, 2]`.
  std::vector<int> integers(const std::string& key, const std::vector<int>& fallback, int lowest, int highest,
                            const std::string& effect = "");
  /// Reads a list of some of the choices; [] if not set.
  std::vector<std::string> selection(const std::string& key, const std::vector<std::string>& choices,
                                     const std::string& effect = "");
  /// Reads a list of texts that are not empty; [] if not set.
  std::vector<std::string> texts(const std::string& key, const std::string& effect = "");
  /// Reads the name of another node, and resolves it as the node itself does.
  std::string node(const std::string& key, const std::string& fallback, const std::string& effect = "");
  /// Reads a list of names of other nodes, each once, and resolves them as the node itself does; [] if not set.
  std::vector<std::string> nodes(const std::string& key, const std::string& effect = "");
  /// Reads a group of finite numbers by their names in the group, each within a range if there is one; empty if not set.
  /// In this and the next two, a name may have slashes, of which the parameter server makes groups within the group.
  std::map<std::string, double> numbers(const std::string& key, const std::string& effect = "",
                                        const std::optional<Range>& range = {});
  /// Reads a group of texts, none of them empty, by their names in the group; empty if not set.
  std::map<std::string, std::string> textsByName(const std::string& key, const std::string& effect = "");
  /// Reads a group of groups, each of which has some of these entries and nothing else: by the names of the inner groups,
  /// then by those of the entries, flags as 0 and 1; empty if not set.
  std::map<std::string, std::map<std::string, double>> groupsByName(const std::string& key,
                                                                    const std::vector<GroupEntry>& entries,
                                                                    const std::string& effect = "");
  /// Reads a list of groups, each of which has these texts, none of them empty, and nothing else; [] if not set. Returns the
  /// texts in the order of `names`.
  std::vector<std::vector<std::string>> groups(const std::string& key, const std::vector<std::string>& names,
                                               const std::string& effect = "");
  /// Reads a list of groups; [] if not set.
  /// @param take  reads one of them and returns it as text; throws sweep_guard_core::InvalidInput in words that follow `must be`
  void groups(const std::string& key, const std::string& wanted, const std::string& effect,
              const std::function<std::string(XmlRpc::XmlRpcValue&)>& take);
  /// Searches a text in the private namespace, then in those above it, or under an absolute name; "" if not set.
  /// The error names only the key.
  std::string searchText(const std::string& name);
  /// Lets a parameter be set that has no effect here.
  void ignore(const std::string& key) { read_.insert(key); }
  /// Reads [x, y, z] [m], each within +-1e6 m; does not check the fallback.
  Eigen::Vector3d position(const std::string& key, const Eigen::Vector3d& fallback);

  /// Returns the known settings, and those of all parameters that were read.
  const Settings& settings() const { return settings_; }
  /// Returns the descriptions in the order of reading; none for text(), position() and searchText().
  const std::vector<ParameterInfo>& described() const { return described_; }

  /// Logs a warning for every private parameter that was not read: a misspelled key has no effect.
  /// @throws sweep_guard_core::InvalidInput if a value is set in place of a group of parameters
  void warnOfUnread() const;

 private:
  void describe(ParameterInfo info);
  std::string optionalText(const std::string& key, const std::string& wanted, const std::string& effect);
  std::string resolved(const std::string& key, const std::string& name) const;
  bool isGroup(const std::string& key) const;
  bool get(const std::string& key, XmlRpc::XmlRpcValue& value);
  std::map<std::string, XmlRpc::XmlRpcValue> entries(const std::string& key, const std::string& wanted);
  bool getList(const std::string& key, const std::string& wanted, XmlRpc::XmlRpcValue& list);
  [[noreturn]] void refuse(const std::string& key, const XmlRpc::XmlRpcValue& value, const std::string& wanted) const;

  ros::NodeHandle node_;
  Settings settings_;
  std::set<std::string> read_;
  std::vector<ParameterInfo> described_;
  bool next_is_live_ = false;
};

}  // namespace sweep_guard_ros
