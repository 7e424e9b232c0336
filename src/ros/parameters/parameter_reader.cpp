#include "sweep_guard/ros/parameters/parameter_reader.h"

#include <ros/console.h>
#include <ros/names.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "common/xyz.h"
#include "ros/parameters/parameter_text.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr double kMaxPosition = 1e6;

}  // namespace

std::string shown(const ParameterValue& value) {
  std::ostringstream text;
  text << std::boolalpha;
  std::visit([&](const auto& held) { text << held; }, value);
  return std::holds_alternative<double>(value) ? yamlNumber(text.str()) : text.str();
}

void ParameterReader::describe(ParameterInfo info) {
  info.live = std::exchange(next_is_live_, false);
  described_.push_back(std::move(info));
}

double ParameterReader::number(const std::string& key, double fallback, const Range& range, const std::string& effect,
                               const std::optional<Range>& narrowed) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) value = fallback;
  const Range& narrowest = narrowed ? *narrowed : range;
  if (!within(toNumber(value), narrowest))
    refuse(key, value, shown(narrowest) + (narrowed ? std::string(": ") + narrowed->note : "") + noteOnText(value));
  describe(
      {key, toNumber(value), fallback, range.lowest, range.highest, {}, sweep_guard_ros::described(range), effect});
  return toNumber(value);
}

int ParameterReader::integer(const std::string& key, int fallback, int lowest, int highest, const std::string& effect) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) value = fallback;
  const std::string wanted = "an integer" + shown(lowest, highest);
  if (!within(value, lowest, highest)) {
    const bool is_integer = toInteger(value).getType() == XmlRpc::XmlRpcValue::TypeInt;
    refuse(key, value, wanted + (is_integer ? noteOnText(value) : ""));
  }
  const int integer = static_cast<int>(value);
  describe({key, integer, fallback, static_cast<double>(lowest), static_cast<double>(highest), {}, wanted, effect});
  return integer;
}

std::vector<int> ParameterReader::integers(const std::string& key, const std::vector<int>& fallback, int lowest,
                                           int highest, const std::string& effect) {
  XmlRpc::XmlRpcValue list;
  const std::string wanted = "a list of " + std::to_string(fallback.size()) + " integers" + shown(lowest, highest);
  std::vector<int> integers;
  const bool set = getList(key, wanted, list);
  for (int i = 0; set && i < list.size(); ++i) {
    XmlRpc::XmlRpcValue integer = toInteger(list[i]);
    if (!within(integer, lowest, highest)) refuse(key, list, wanted);
    integers.push_back(static_cast<int>(integer));
  }
  if (!set) integers = fallback;
  if (integers.size() != fallback.size()) refuse(key, list, wanted);
  describe({key, bracketed(integers), bracketed(fallback), 0.0, 0.0, {}, wanted, effect});
  return integers;
}

bool ParameterReader::flag(const std::string& key, bool fallback, const std::string& effect) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) value = fallback;
  if (value.getType() != XmlRpc::XmlRpcValue::TypeBoolean) refuse(key, value, "true or false");
  describe({key, static_cast<bool>(value), fallback, 0.0, 1.0, {}, "true or false", effect});
  return static_cast<bool>(value);
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) refuse(key, value, "a text; put it in quotes");
  return static_cast<std::string>(value);
}

std::string ParameterReader::name(const std::string& key, const std::string& fallback, const std::string& effect) {
  std::string name = text(key, fallback);
  const std::string wanted = "a name, not empty";
  if (name.empty()) refuse(key, XmlRpc::XmlRpcValue(name), wanted);
  describe({key, name, fallback, 0.0, 0.0, {}, wanted, effect});
  return name;
}

std::string ParameterReader::optionalName(const std::string& key, const std::string& effect) {
  return optionalText(key, "a name, or empty", effect);
}

std::string ParameterReader::path(const std::string& key, const std::string& effect) {
  return optionalText(key, "an absolute path, or empty", effect);
}

std::string ParameterReader::optionalText(const std::string& key, const std::string& wanted,
                                          const std::string& effect) {
  std::string read = text(key, "");
  describe({key, read, std::string(), 0.0, 0.0, {}, wanted, effect});
  return read;
}

std::string ParameterReader::choice(const std::string& key, const std::string& fallback,
                                    const std::vector<std::string>& choices, const std::string& effect) {
  std::string chosen = text(key, fallback);
  const std::string wanted = "one of " + listed(choices);
  if (std::count(choices.begin(), choices.end(), chosen) == 0) refuse(key, XmlRpc::XmlRpcValue(chosen), wanted);
  describe({key, chosen, fallback, 0.0, 0.0, choices, wanted, effect});
  return chosen;
}

std::vector<std::string> ParameterReader::selection(const std::string& key, const std::vector<std::string>& choices,
                                                    const std::string& effect) {
  XmlRpc::XmlRpcValue list;
  const std::string wanted = "a list of some of " + listed(choices) + ", or []";
  std::vector<std::string> selection;
  const bool set = getList(key, wanted, list);
  for (int i = 0; set && i < list.size(); ++i) {
    if (list[i].getType() != XmlRpc::XmlRpcValue::TypeString) refuse(key, list, wanted);
    selection.push_back(static_cast<std::string>(list[i]));
    if (std::count(choices.begin(), choices.end(), selection.back()) == 0) refuse(key, list, wanted);
  }
  describe({key, bracketed(selection), std::string("[]"), 0.0, 0.0, {}, wanted, effect});
  return selection;
}

std::vector<std::string> ParameterReader::texts(const std::string& key, const std::string& effect) {
  XmlRpc::XmlRpcValue value;
  const std::string wanted = "a list of texts, or []";
  std::vector<std::string> texts;
  const bool set = getList(key, wanted, value);
  for (int i = 0; set && i < value.size(); ++i) {
    if (value[i].getType() != XmlRpc::XmlRpcValue::TypeString) refuse(key, value, wanted);
    texts.push_back(static_cast<std::string>(value[i]));
    if (texts.back().empty()) refuse(key, value, wanted + ", none of them empty");
  }
  describe({key, bracketed(texts), std::string("[]"), 0.0, 0.0, {}, wanted, effect});
  return texts;
}

// A nodelet has not the namespace of its process.
std::string ParameterReader::resolved(const std::string& key, const std::string& name) const {
  std::string error;
  if (ros::names::validate(name, error))
    return ros::names::resolve(ros::names::parentNamespace(node_.getNamespace()), name);
  throw sweep_guard_core::InvalidInput("parameter " + key + " has no name of a node: " + error);
}

std::string ParameterReader::node(const std::string& key, const std::string& fallback, const std::string& effect) {
  return resolved(key, name(key, fallback, effect));
}

std::vector<std::string> ParameterReader::nodes(const std::string& key, const std::string& effect) {
  const auto refusal = [&](const std::string& why) {
    return sweep_guard_core::InvalidInput("parameter " + key + " has " + why);
  };
  std::vector<std::string> nodes;
  for (const std::string& name : texts(key, effect)) {
    nodes.push_back(resolved(key, name));
    if (std::count(nodes.begin(), nodes.end(), nodes.back()) > 1) {
      throw refusal(nodes.back() + " twice: name each node once");
    }
    if (nodes.back() == node_.getNamespace()) {
      throw refusal(nodes.back() + ", which is this node: name the others alone");
    }
  }
  return nodes;
}

std::vector<std::vector<std::string>> ParameterReader::groups(const std::string& key,
                                                              const std::vector<std::string>& names,
                                                              const std::string& effect) {
  XmlRpc::XmlRpcValue list;
  const std::string wanted =
      "a list of groups " + grouped(names, std::vector<std::string>(names.size(), "TEXT")) + ", or []";
  std::vector<std::vector<std::string>> groups;
  std::vector<std::string> entries;
  const bool set = getList(key, wanted, list);
  for (int i = 0; set && i < list.size(); ++i) {
    groups.push_back(textsOf(list[i], names));
    if (groups.back().empty()) refuse(key, list, wanted + ", none of the texts empty");
    entries.push_back(grouped(names, groups.back()));
  }
  describe({key, bracketed(entries), std::string("[]"), 0.0, 0.0, {}, wanted, effect});
  return groups;
}

std::map<std::string, XmlRpc::XmlRpcValue> ParameterReader::entries(const std::string& key, const std::string& wanted) {
  XmlRpc::XmlRpcValue group;
  if (!get(key, group)) return {};
  if (group.getType() != XmlRpc::XmlRpcValue::TypeStruct) refuse(key, group, wanted);
  auto entries = flattened(group);
  for (const auto& [name, entry] : entries) read_.insert(std::string(key).append("/").append(name));
  return entries;
}

std::map<std::string, double> ParameterReader::numbers(const std::string& key, const std::string& effect,
                                                       const std::optional<Range>& range) {
  const std::string wanted = "a group of numbers, or {}";
  std::map<std::string, double> numbers;
  std::vector<std::string> shown_entries;
  for (const auto& [name, entry] : entries(key, wanted)) {
    const std::string entry_key = std::string(key).append("/").append(name);
    const double number = toNumber(entry);
    if (!std::isfinite(number)) refuse(entry_key, entry, "a finite number" + noteOnText(entry));
    if (range && !within(number, *range)) refuse(entry_key, entry, shown(*range));
    numbers[name] = number;
    shown_entries.push_back(name + ": " + shown(ParameterValue(number)));
  }
  describe({key, braced(shown_entries), std::string("{}"), 0.0, 0.0, {}, wanted, effect});
  return numbers;
}

std::map<std::string, std::string> ParameterReader::textsByName(const std::string& key, const std::string& effect) {
  const std::string wanted = "a group of texts, or {}";
  std::map<std::string, std::string> texts;
  std::vector<std::string> shown_entries;
  for (const auto& [name, entry] : entries(key, wanted)) {
    const std::string entry_key = std::string(key).append("/").append(name);
    if (entry.getType() != XmlRpc::XmlRpcValue::TypeString) refuse(entry_key, entry, "a text");
    texts[name] = static_cast<std::string>(entry);
    if (texts[name].empty()) refuse(entry_key, entry, "a text, not empty");
    shown_entries.push_back(name + ": " + texts[name]);
  }
  describe({key, braced(shown_entries), std::string("{}"), 0.0, 0.0, {}, wanted, effect});
  return texts;
}

std::string ParameterReader::searchText(const std::string& name) {
  std::string key;
  XmlRpc::XmlRpcValue value;
  read_.insert(name);
  const auto known = settings_.find(name);
  if (known != settings_.end()) return known->second ? static_cast<std::string>(*known->second) : "";
  settings_[name] = std::nullopt;
  if (!node_.searchParam(name, key) || !node_.getParam(key, value)) return "";
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) {
    throw sweep_guard_core::InvalidInput("parameter " + key + " must be a text");
  }
  settings_[name] = value;
  return static_cast<std::string>(value);
}

Eigen::Vector3d ParameterReader::position(const std::string& key, const Eigen::Vector3d& fallback) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  const Range range{-kMaxPosition, kMaxPosition};
  const std::string wanted = "three times " + shown(range);
  if (value.getType() != XmlRpc::XmlRpcValue::TypeArray || value.size() != 3) refuse(key, value, wanted);
  Eigen::Vector3d position(toNumber(value[0]), toNumber(value[1]), toNumber(value[2]));
  for (const double coordinate : sweep_guard_core::xyz(position)) {
    if (!within(coordinate, range)) refuse(key, value, wanted + noteOnText(value));
  }
  return position;
}

void ParameterReader::warnOfUnread() const {
  std::vector<std::string> names;
  node_.getParamNames(names);
  const std::string prefix = node_.getNamespace() + "/";
  for (const std::string& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string key = name.substr(prefix.size());
    XmlRpc::XmlRpcValue value;
    if (isGroup(key) && node_.getParam(key, value)) refuse(key, value, "a group of parameters");
    if (read_.count(key) == 0) ROS_WARN("parameter %s is unknown and has no effect", name.c_str());
  }
}

bool ParameterReader::isGroup(const std::string& key) const {
  const auto first_inside = read_.lower_bound(key + "/");
  return first_inside != read_.end() && first_inside->compare(0, key.size() + 1, key + "/") == 0;
}

bool ParameterReader::get(const std::string& key, XmlRpc::XmlRpcValue& value) {
  read_.insert(key);
  auto setting = settings_.find(key);
  if (setting == settings_.end()) {
    setting = settings_.emplace(key, std::nullopt).first;
    if (node_.getParam(key, value)) setting->second = value;
  }
  if (setting->second) value = *setting->second;
  return setting->second.has_value();
}

bool ParameterReader::getList(const std::string& key, const std::string& wanted, XmlRpc::XmlRpcValue& list) {
  if (!get(key, list)) return false;
  if (list.getType() == XmlRpc::XmlRpcValue::TypeString) list = split(static_cast<std::string>(list));
  if (list.getType() != XmlRpc::XmlRpcValue::TypeArray) refuse(key, list, wanted);
  return true;
}

// Names of joints are no names of ROS: resolveName() would throw.
void ParameterReader::refuse(const std::string& key, const XmlRpc::XmlRpcValue& value,
                             const std::string& wanted) const {
  std::ostringstream shown_value;
  value.write(shown_value);
  throw sweep_guard_core::InvalidInput("parameter " + node_.getNamespace() + "/" + sweep_guard_core::printable(key) +
                                       " is " + shown_value.str() + ", but must be " + wanted);
}

}  // namespace sweep_guard_ros
