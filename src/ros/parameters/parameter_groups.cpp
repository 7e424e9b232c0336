#include <algorithm>
#include <limits>

#include "ros/parameters/parameter_text.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {
namespace {

using Groups = std::map<std::string, std::map<std::string, double>>;

std::string wantedOf(const GroupEntry& entry) { return entry.range ? described(*entry.range) : "true or false"; }

std::string formOf(const std::vector<GroupEntry>& entries) {
  std::vector<std::string> names;
  std::vector<std::string> wanted;
  for (const GroupEntry& entry : entries) {
    names.push_back(entry.name);
    wanted.push_back(wantedOf(entry));
  }
  return grouped(names, wanted);
}

// Returns NaN for a value that does not fit.
double valueOf(const XmlRpc::XmlRpcValue& value, const GroupEntry& entry) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const bool is_flag = value.getType() == XmlRpc::XmlRpcValue::TypeBoolean;
  if (!entry.range) return is_flag ? static_cast<double>(static_cast<bool>(value)) : kNone;
  return within(toNumber(value), *entry.range) ? toNumber(value) : kNone;
}

std::string shownValue(double value, const GroupEntry& entry) {
  return shown(entry.range ? ParameterValue(value) : ParameterValue(value != 0.0));
}

std::string shownGroups(const Groups& groups, const std::vector<GroupEntry>& entries) {
  std::vector<std::string> shown_groups;
  for (const auto& [name, group] : groups) {
    std::vector<std::string> names;
    std::vector<std::string> values;
    for (const GroupEntry& entry : entries) {
      const auto found = group.find(entry.name);
      if (found == group.end()) continue;
      names.push_back(entry.name);
      values.push_back(shownValue(found->second, entry));
    }
    shown_groups.push_back((name == "*" ? "'*'" : name) + ": " + grouped(names, values));
  }
  return braced(shown_groups);
}

}  // namespace

Groups ParameterReader::groupsByName(const std::string& key, const std::vector<GroupEntry>& entries,
                                     const std::string& effect) {
  const std::string wanted = "a group of groups of " + formOf(entries) + ", or {}";
  Groups groups;
  for (const auto& [path, value] : this->entries(key, wanted)) {
    const std::string path_key = std::string(key).append("/").append(path);
    const size_t slash = std::min(path.rfind('/'), path.size());
    const std::string name = path.substr(std::min(slash + 1, path.size()));
    const auto same = [&](const GroupEntry& entry) { return entry.name == name; };
    const auto entry = std::find_if(entries.begin(), entries.end(), same);
    if (slash == path.size() || entry == entries.end()) refuse(path_key, value, wanted);
    const double number = valueOf(value, *entry);
    if (number != number) refuse(path_key, value, wantedOf(*entry) + noteOnText(value));
    groups[path.substr(0, slash)][name] = number;
  }
  describe({key, shownGroups(groups, entries), std::string("{}"), 0.0, 0.0, {}, wanted, effect});
  return groups;
}

void ParameterReader::groups(const std::string& key, const std::string& wanted, const std::string& effect,
                             const std::function<std::string(XmlRpc::XmlRpcValue&)>& take) {
  XmlRpc::XmlRpcValue list;
  std::vector<std::string> entries;
  const bool set = getList(key, wanted, list);
  for (int i = 0; set && i < list.size(); ++i) {
    try {
      entries.push_back(take(list[i]));
    } catch (const sweep_guard_core::InvalidInput& error) {
      refuse(key, list, error.what());
    }
  }
  describe({key, bracketed(entries), std::string("[]"), 0.0, 0.0, {}, wanted, effect});
}

}  // namespace sweep_guard_ros
