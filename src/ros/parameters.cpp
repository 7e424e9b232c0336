#include "sweep_guard/ros/parameters.h"

#include <ros/console.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Duration;
using sweep_guard::InvalidInput;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Range {
  double lowest;
  double highest;
};

std::string shown(const XmlRpc::XmlRpcValue& value) {
  std::ostringstream text;
  value.write(text);
  return text.str();
}

class Reader {
 public:
  explicit Reader(const ros::NodeHandle& node) : node_(node) {}

  double number(const std::string& key, double fallback, const Range& range) {
    std::ostringstream wanted;
    wanted << "a number from " << range.lowest << " to " << range.highest;
    XmlRpc::XmlRpcValue value;
    if (!get(key, value)) return fallback;
    double number = std::numeric_limits<double>::quiet_NaN();
    if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) number = static_cast<double>(value);
    if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) number = static_cast<int>(value);
    if (!(number >= range.lowest && number <= range.highest)) refuse(key, value, wanted.str());
    return number;
  }

  int integer(const std::string& key, int fallback, int lowest, int highest) {
    XmlRpc::XmlRpcValue value;
    if (!get(key, value)) return fallback;
    const bool right = value.getType() == XmlRpc::XmlRpcValue::TypeInt && static_cast<int>(value) >= lowest &&
                       static_cast<int>(value) <= highest;
    if (!right) refuse(key, value, "an integer from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return static_cast<int>(value);
  }

  bool flag(const std::string& key, bool fallback) {
    XmlRpc::XmlRpcValue value;
    if (!get(key, value)) return fallback;
    if (value.getType() != XmlRpc::XmlRpcValue::TypeBoolean) refuse(key, value, "true or false");
    return static_cast<bool>(value);
  }

  std::string frame(const std::string& key, const std::string& fallback) {
    XmlRpc::XmlRpcValue value;
    if (!get(key, value)) return fallback;
    if (value.getType() != XmlRpc::XmlRpcValue::TypeString || static_cast<std::string>(value).empty()) {
      refuse(key, value, "the name of a tf frame");
    }
    return static_cast<std::string>(value);
  }

  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices) {
    XmlRpc::XmlRpcValue value;
    if (!get(key, value)) return fallback;
    std::string wanted;
    for (const std::string& one : choices) {
      if (value.getType() == XmlRpc::XmlRpcValue::TypeString && static_cast<std::string>(value) == one) return one;
      wanted += (wanted.empty() ? "one of " : ", ") + one;
    }
    refuse(key, value, wanted);
  }

  void warnOfUnread() const {
    std::vector<std::string> names;
    node_.getParamNames(names);
    const std::string prefix = node_.getNamespace() + "/";
    for (const std::string& name : names) {
      if (name.compare(0, prefix.size(), prefix) == 0 && read_.count(name.substr(prefix.size())) == 0) {
        ROS_WARN("parameter %s is unknown and has no effect: see config/sweep_guard.yaml", name.c_str());
      }
    }
  }

 private:
  bool get(const std::string& key, XmlRpc::XmlRpcValue& value) {
    read_.insert(key);
    return node_.getParam(key, value);
  }

  [[noreturn]] void refuse(const std::string& key, const XmlRpc::XmlRpcValue& value, const std::string& wanted) const {
    throw InvalidInput("parameter " + node_.resolveName(key) + " is " + shown(value) + ", but must be " + wanted);
  }

  const ros::NodeHandle& node_;
  std::set<std::string> read_;
};

Duration duration(double seconds) { return std::isinf(seconds) ? Duration::max() : sweep_guard::fromSeconds(seconds); }

}  // namespace

sweep_guard::Tool Parameters::tool() const { return sweep_guard::Tool::cylinder(tool_radius, tool_length, tool_sides); }

Parameters loadParameters(const ros::NodeHandle& private_node) {
  Reader read(private_node);
  Parameters parameters;
  parameters.fixed_frame = read.frame("fixed_frame", "world");
  parameters.tool_source =
      read.choice("tool_source", "topic", {"topic", "tf"}) == "tf" ? ToolSource::kTf : ToolSource::kTopic;
  parameters.tool_frame = read.frame("tool_frame", "tool");
  read.choice("tool/type", "cylinder", {"cylinder"});
  parameters.tool_radius = read.number("tool/radius", 0.01, {1e-6, 100.0});
  parameters.tool_length = read.number("tool/length", 0.15, {1e-6, 100.0});
  parameters.tool_sides = read.integer("tool/sides", 32, 3, 1000);
  parameters.detector = read.choice("detector", "select", sweep_guard::detectorNames());
  parameters.cull = read.flag("cull", true);
  parameters.sweep.volume = sweep_guard::volumeKind(read.choice("volume", "obb_planes", {"obb", "obb_planes"}));
  parameters.sweep.max_rotation = read.number("max_rotation_per_sweep", 0.175, {0.001, 0.5});
  parameters.limits.hold_time = duration(read.number("warning/hold_time", 0.5, {0.0, 60.0}));
  parameters.limits.pose_timeout = duration(read.number("timing/pose_timeout", 0.1, {0.01, 2.0}));
  parameters.limits.mesh_timeout = duration(read.number("timing/mesh_timeout", 0.5, {0.01, kInfinity}));
  parameters.marker_rate = read.number("timing/marker_rate", 15.0, {0.1, 100.0});
  parameters.max_triangles = static_cast<size_t>(read.integer("limits/max_triangles", 1000000, 1, 10000000));
  read.warnOfUnread();
  return parameters;
}

}  // namespace sweep_guard_ros
