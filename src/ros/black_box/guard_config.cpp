#include "ros/black_box/guard_config.h"

#include <ros/master.h>
#include <ros/names.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/number_text.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

constexpr const char* kHead =
    "# The parameters of the guard when the bag beside this file was written.\n"
    "# roslaunch sweep_guard replay.launch plays the bag with them.\n";
const std::string kRobotDescription = "robot_description";

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
      char code[5];
      std::snprintf(code, sizeof(code), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      result += code;
    } else {
      result += c;
    }
  }
  return result + '"';
}

// YAML 1.1, which rosparam reads, takes a number without a point for an integer, and with an exponent for a text.
std::string numberText(double number) {
  if (std::isnan(number)) return ".nan";
  if (std::isinf(number)) return number > 0 ? ".inf" : "-.inf";
  std::string text = sweep_guard_core::shortestText(number);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t end = std::min(text.find('e'), text.size());
  return text.substr(0, end) + ".0" + text.substr(end);
}

std::string inLine(const XmlRpcValue& value);

std::string joined(const std::string& list, const std::string& next) {
  return list + (list.empty() ? "" : ", ") + next;
}

std::string listText(const XmlRpcValue& value) {
  std::string list;
  for (int i = 0; i < value.size(); ++i) list = joined(list, inLine(value[i]));
  return '[' + list + ']';
}

std::string groupText(const XmlRpcValue& value) {
  std::string list;
  for (const auto& [key, member] : value) list = joined(list, quoted(key) + ": " + inLine(member));
  return '{' + list + '}';
}

std::string inLine(const XmlRpcValue& value) {
  XmlRpcValue copy = value;  // its conversions are not const everywhere
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(copy) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(copy));
    case XmlRpcValue::TypeDouble:
      return numberText(static_cast<double>(copy));
    case XmlRpcValue::TypeString:
      return quoted(static_cast<std::string>(copy));
    case XmlRpcValue::TypeArray:
      return listText(value);
    case XmlRpcValue::TypeStruct:
      return groupText(value);
    default:
      return "null";
  }
}

void append(std::string& text, const XmlRpcValue& group, const std::string& indent) {
  for (const auto& [key, value] : group) {
    const bool block = value.getType() == XmlRpcValue::TypeStruct && value.size() > 0;
    text += indent + quoted(key) + (block ? ":\n" : ": " + inLine(value) + '\n');
    if (block) append(text, value, indent + "  ");
  }
}

}  // namespace

std::string toYaml(const XmlRpcValue& value) {
  if (value.getType() != XmlRpcValue::TypeStruct || value.size() == 0) return inLine(value) + '\n';
  std::string text;
  append(text, value, "");
  return text;
}

void GuardConfig::refresh() {
  std::optional<XmlRpcValue> parameters = get(guard_);
  if (!parameters || parameters->getType() != XmlRpcValue::TypeStruct) return;
  if (parameters->hasMember("tool") && (*parameters)["tool"].getType() != XmlRpcValue::TypeStruct)
    return;  // refused by the guard
  if (const auto description = robotDescription(*parameters)) {
    (*parameters)[kRobotDescription] = *description;
    (*parameters)["tool"][kRobotDescription] = kRobotDescription;
  }
  parameters_ = *parameters;
}

std::string GuardConfig::yaml() const { return kHead + (parameters_.valid() ? toYaml(parameters_) : "{}\n"); }

std::optional<XmlRpcValue> GuardConfig::get(const std::string& name) const {
  const auto answer = call_.call(ros::master::getURI(), "getParam", {XmlRpcValue(name)});
  if (!answer || !answer->success) return std::nullopt;
  return answer->value;
}

// As the guard does: from its namespace upwards.
std::optional<XmlRpcValue> GuardConfig::robotDescription(const XmlRpcValue& parameters) const {
  std::string name = kRobotDescription;
  if (parameters.hasMember("tool") && parameters["tool"].hasMember(kRobotDescription)) {
    XmlRpcValue set = parameters["tool"][kRobotDescription];
    if (set.getType() == XmlRpcValue::TypeString) name = static_cast<std::string>(set);
  }
  std::string scope = guard_;
  while (true) {
    auto text = get(ros::names::resolve(scope, name, /*remap=*/false));
    if (text && text->getType() == XmlRpcValue::TypeString) return text;
    if (scope == "/" || name.empty() || name.front() == '/') return std::nullopt;
    scope = ros::names::parentNamespace(scope);
  }
}

}  // namespace sweep_guard_ros
