#include "simulation/parameters.h"

#include <xmlrpcpp/XmlRpcValue.h>

#include <sstream>
#include <vector>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

namespace {

constexpr double kFarthest = 1e6;

[[noreturn]] void refuse(const ros::NodeHandle& node, const std::string& key, const std::string& range) {
  XmlRpc::XmlRpcValue value;
  node.getParam(key, value);
  std::ostringstream text;
  text << "parameter " << node.resolveName(key) << " is '" << value << "', must be " << range;
  throw sweep_guard::InvalidInput(text.str());
}

template <typename Number>
std::string interval(const std::string& kind, Number min, Number max) {
  std::ostringstream text;
  text << kind << " in [" << min << ", " << max << "]";
  return text.str();
}

}  // namespace

double Parameters::number(const std::string& key, double fallback, double min, double max) const {
  if (!node_.hasParam(key)) return fallback;
  double value = 0.0;
  if (!node_.getParam(key, value) || !(value >= min && value <= max))
    refuse(node_, key, interval("a number", min, max));
  return value;
}

int Parameters::integer(const std::string& key, int fallback, int min, int max) const {
  if (!node_.hasParam(key)) return fallback;
  XmlRpc::XmlRpcValue value;
  node_.getParam(key, value);
  const bool valid = value.getType() == XmlRpc::XmlRpcValue::TypeInt && static_cast<int>(value) >= min &&
                     static_cast<int>(value) <= max;
  if (!valid) refuse(node_, key, interval("a whole number", min, max));
  return static_cast<int>(value);
}

bool Parameters::boolean(const std::string& key, bool fallback) const {
  if (!node_.hasParam(key)) return fallback;
  bool value = false;
  if (!node_.getParam(key, value)) refuse(node_, key, "true or false");
  return value;
}

std::string Parameters::text(const std::string& key, const std::string& fallback) const {
  if (!node_.hasParam(key)) return fallback;
  std::string value;
  if (!node_.getParam(key, value)) refuse(node_, key, "a text; put it in quotes");
  return value;
}

std::string Parameters::name(const std::string& key, const std::string& fallback) const {
  std::string value = text(key, fallback);
  if (value.empty()) refuse(node_, key, "a name, not empty");
  return value;
}

Eigen::Vector3d Parameters::position(const std::string& key, const Eigen::Vector3d& fallback) const {
  if (!node_.hasParam(key)) return fallback;
  std::vector<double> value;
  const bool valid = node_.getParam(key, value) && value.size() == 3 &&
                     Eigen::Map<const Eigen::Array3d>(value.data()).abs().maxCoeff() <= kFarthest &&
                     Eigen::Map<const Eigen::Array3d>(value.data()).allFinite();
  if (!valid) refuse(node_, key, interval("a list of three numbers", -kFarthest, kFarthest));
  return Eigen::Vector3d(value[0], value[1], value[2]);
}

}  // namespace sweep_guard_simulation
