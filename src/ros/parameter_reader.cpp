#include "sweep_guard/ros/parameter_reader.h"

#include <ros/console.h>

#include <limits>
#include <sstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr double kFarthest = 1e6;

double toNumber(const XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) return static_cast<double>(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return static_cast<int>(value);
  return std::numeric_limits<double>::quiet_NaN();
}

bool within(double number, const ParameterReader::Range& range) {
  return number >= range.lowest && number <= range.highest;
}

std::string shown(const ParameterReader::Range& range) {
  std::ostringstream text;
  text << "a number from " << range.lowest << " to " << range.highest;
  return text.str();
}

}  // namespace

double ParameterReader::number(const std::string& key, double fallback, const Range& range) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  if (!within(toNumber(value), range)) refuse(key, value, shown(range));
  return toNumber(value);
}

int ParameterReader::integer(const std::string& key, int fallback, int lowest, int highest) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  const bool right = value.getType() == XmlRpc::XmlRpcValue::TypeInt && static_cast<int>(value) >= lowest &&
                     static_cast<int>(value) <= highest;
  if (!right) refuse(key, value, "an integer from " + std::to_string(lowest) + " to " + std::to_string(highest));
  return static_cast<int>(value);
}

bool ParameterReader::flag(const std::string& key, bool fallback) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  if (value.getType() != XmlRpc::XmlRpcValue::TypeBoolean) refuse(key, value, "true or false");
  return static_cast<bool>(value);
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) refuse(key, value, "a text; put it in quotes");
  return static_cast<std::string>(value);
}

std::string ParameterReader::name(const std::string& key, const std::string& fallback) {
  std::string name = text(key, fallback);
  if (name.empty()) refuse(key, XmlRpc::XmlRpcValue(name), "a name, not empty");
  return name;
}

std::string ParameterReader::choice(const std::string& key, const std::string& fallback,
                                    const std::vector<std::string>& choices) {
  const std::string chosen = text(key, fallback);
  std::string wanted;
  for (const std::string& one : choices) {
    if (chosen == one) return one;
    wanted += (wanted.empty() ? "one of " : ", ") + one;
  }
  refuse(key, XmlRpc::XmlRpcValue(chosen), wanted);
}

Eigen::Vector3d ParameterReader::position(const std::string& key, const Eigen::Vector3d& fallback) {
  XmlRpc::XmlRpcValue value;
  if (!get(key, value)) return fallback;
  const Range range{-kFarthest, kFarthest};
  const std::string wanted = "three times " + shown(range);
  if (value.getType() != XmlRpc::XmlRpcValue::TypeArray || value.size() != 3) refuse(key, value, wanted);
  Eigen::Vector3d position(toNumber(value[0]), toNumber(value[1]), toNumber(value[2]));
  for (const double coordinate : position) {
    if (!within(coordinate, range)) refuse(key, value, wanted);
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
  return node_.getParam(key, value);
}

void ParameterReader::refuse(const std::string& key, const XmlRpc::XmlRpcValue& value,
                             const std::string& wanted) const {
  std::ostringstream shown_value;
  value.write(shown_value);
  throw sweep_guard::InvalidInput("parameter " + node_.resolveName(key) + " is " + shown_value.str() +
                                  ", but must be " + wanted);
}

}  // namespace sweep_guard_ros
