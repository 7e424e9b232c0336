// Parameters of any type and shape: at the start from the parameter server, then as changes while the guard runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "common/floating_point.h"
#include "require.h"
#include "ros/haptics/haptics_parameters.h"
#include "ros/motion/motion_parameters.h"
#include "ros/parameters/parameter_changes.h"
#include "roscpp_alone.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/haptics/passive_device.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::kInfinity;
using sweep_guard_ros::ParameterInfo;
using sweep_guard_ros::Parameters;
using sweep_guard_ros::ParameterValue;

constexpr std::array<double, 16> kNumbers = {0.0, -0.0, 1.0,  -1.0,  0.5,    0.1,       1e-6,       100.0,
                                             1e9, 1e10, 1e19, 1e300, 5e-324, kInfinity, -kInfinity, NAN};
const std::string kRobot =
    "<robot name='r'><link name='tool'><collision><geometry><box size='1 1 1'/></geometry></collision></link></robot>";

// All that the node reads without any setting.
template <typename Loaded>
struct Defaults {
  explicit Defaults(Loaded loaded) : parameters(std::move(loaded)) {
    for (const auto& [key, value] : parameters.settings) keys.push_back(key);
    keys.insert(keys.end(), {"tool", "horizon", "nothing"});
  }

  const ParameterInfo* described(const std::string& key) const {
    for (const ParameterInfo& info : parameters.described) {
      if (info.key == key) return &info;
    }
    return nullptr;
  }

  Loaded parameters;
  std::vector<std::string> keys;
};

double numberFrom(Input& input) {
  const int how = input.byte();
  return how < 128 ? kNumbers[static_cast<size_t>(how) % kNumbers.size()] : input.raw<double>();
}

std::string wordFrom(Input& input, const ParameterInfo* info) {
  const int how = input.byte();
  if (info != nullptr && how < 128 && !info->choices.empty())
    return info->choices[static_cast<size_t>(how) % info->choices.size()];
  return how % 8 == 0 ? kRobot : input.word();
}

ParameterValue changeFrom(Input& input, const ParameterInfo* info) {
  const int how = input.byte();
  const bool fits = info != nullptr && how >= 128;
  switch (fits ? info->value.index() : static_cast<size_t>(how) % 4) {
    case 0:
      return input.flag();
    case 1:
      return input.flag() ? input.raw<int>() : input.byte() - 1;
    case 2:
      return numberFrom(input);
    default:
      return wordFrom(input, info);
  }
}

XmlRpc::XmlRpcValue valueFrom(Input& input, const ParameterInfo* info, int depth = 0) {
  using XmlRpc::XmlRpcValue;
  const int how = input.byte();
  if (info != nullptr && how % 2 == 1) {
    return std::visit([](const auto& held) { return XmlRpcValue(held); }, changeFrom(input, info));
  }
  XmlRpcValue value;
  switch (how / 2 % (depth < 2 ? 8 : 5)) {
    case 0:
      return XmlRpcValue(input.raw<int>());
    case 1:
      return XmlRpcValue(input.byte() - 128);
    case 2:
      return XmlRpcValue(numberFrom(input));
    case 3:
      return XmlRpcValue(input.flag());
    case 4:
      return XmlRpcValue(wordFrom(input, info));
    case 5: {
      value.setSize(how / 64);
      for (int i = 0; i < how / 64; ++i) value[i] = valueFrom(input, info, depth + 1);
      return value;
    }
    case 6:
      value.begin();  // makes it a group
      for (int i = 0; i < how / 64; ++i) value[wordFrom(input, nullptr)] = valueFrom(input, info, depth + 1);
      return value;
    default: {
      std::string bytes = wordFrom(input, nullptr);
      return XmlRpcValue(bytes.data(), static_cast<int>(bytes.size()));
    }
  }
}

template <typename Loaded>
void setServer(Input& input, const Defaults<Loaded>& defaults, const std::string& node) {
  serverParameters().clear();
  const std::string scope = node + "/";
  for (int count = input.below(8); count > 0; --count) {
    const std::string& key = defaults.keys[static_cast<size_t>(input.byte()) % defaults.keys.size()];
    serverParameters()[scope + key] = valueFrom(input, defaults.described(key));
  }
  if (input.below(4) == 3) serverParameters()["/robot_description"] = valueFrom(input, nullptr);
}

void checkRanges(const std::vector<ParameterInfo>& described, const std::vector<ParameterInfo>& defaults) {
  require(described.size() == defaults.size(), "always the same parameters");
  for (size_t i = 0; i < described.size(); ++i) {
    const ParameterInfo& info = described[i];
    require(info.key == defaults[i].key, "always in the same order");
    require(info.value.index() == defaults[i].value.index(), "always of the same type");
    if (const auto* number = std::get_if<double>(&info.value)) {
      require(*number >= info.lowest && *number <= info.highest, "a number is in its range");
    }
    if (const auto* integer = std::get_if<int>(&info.value)) {
      require(*integer >= info.lowest && *integer <= info.highest, "an integer is in its range");
    }
    const auto* text = std::get_if<std::string>(&info.value);
    const auto& choices = info.choices;
    require(text == nullptr || choices.empty() || std::count(choices.begin(), choices.end(), *text) == 1,
            "a choice is one");
  }
}

// What is accepted makes a guard, and limits that warnings can be computed with.
void checkUsable(const Parameters& parameters) {
  using sweep_guard_core::Duration;
  const auto& limits = parameters.limits;
  for (const Duration positive : {limits.pose_timeout, limits.mesh_timeout, limits.reflex, limits.acknowledge_time,
                                  parameters.check_sweep_deadline, parameters.guard.cycle}) {
    require(positive > Duration::zero(), "a time is above 0");
  }
  require(limits.hold_time >= Duration::zero() && limits.reflex < limits.considered, "times are in order");
  const auto& [reflex, on, off] = limits.thresholds;
  require(reflex > 0.0 && reflex <= 1.0 && off > 0.0 && off <= on && on <= 1.0,
          "thresholds are probabilities, in order");
  require(parameters.max_triangles >= 1 && parameters.max_triangles <= 10000000, "meshes are bounded");
  require(parameters.max_message_size >= 1, "messages are bounded");
  require(!parameters.fixed_frame.empty() && !parameters.tool_frame.empty(), "frames have names");
  require(std::isfinite(parameters.tool->boundingRadius()), "the tool ends somewhere");
}

void checkGuard(Input& input) {
  static const ros::NodeHandle node("/guard");
  static const Defaults<Parameters> defaults(sweep_guard_ros::loadParameters(node));
  setServer(input, defaults, "/guard");
  Parameters parameters = defaults.parameters;
  try {
    parameters = sweep_guard_ros::loadParameters(node);
  } catch (const InvalidInput&) {
    serverParameters().clear();
  }
  checkRanges(parameters.described, defaults.parameters.described);
  for (int request = 0; request < 3 && !input.atEnd(); ++request) {
    std::map<std::string, ParameterValue> changes;
    for (int count = 1 + input.below(3); count > 0; --count) {
      const std::string& key = defaults.keys[static_cast<size_t>(input.byte()) % defaults.keys.size()];
      changes[key] = changeFrom(input, defaults.described(key));
    }
    try {
      Parameters next = sweep_guard_ros::changeParameters(node, parameters, changes);
      for (const auto& change : differences(parameters, next)) {
        require(defaults.described(change.key)->live, "only what may change changes");
      }
      parameters = std::move(next);
    } catch (const InvalidInput&) {
    }
    checkRanges(parameters.described, defaults.parameters.described);
    checkUsable(parameters);
  }
  const sweep_guard_core::Guard guard(*parameters.tool, sweep_guard_core::makeDetector("reference"), parameters.guard);
  require(differences(parameters, sweep_guard_ros::changeParameters(node, parameters, {})).empty(),
          "nothing changes by itself");
}

// Of a node whose parameters do not change while it runs.
template <typename Loaded>
void checkStart(Input& input, const std::string& name, Loaded (*load)(const ros::NodeHandle&),
                void (*use)(const Loaded&)) {
  static const ros::NodeHandle node(name);
  static const Defaults<Loaded> defaults(load(node));
  setServer(input, defaults, name);
  try {
    const Loaded parameters = load(node);
    checkRanges(parameters.described, defaults.parameters.described);
    use(parameters);
  } catch (const InvalidInput&) {
  }
}

void useMotion(const sweep_guard_ros::MotionParameters& parameters) {
  require(std::isfinite(parameters.linear_scale) && std::isfinite(parameters.angular_scale), "a scale is finite");
  const sweep_guard_core::MotionGuard guard(parameters.options);
}

// A ball 3 mm within the plane z = 0, whose normal is its z axis.
sweep_guard_core::ForceInputs pressedBall(const sweep_guard_core::Instant& at) {
  auto tool = std::make_shared<sweep_guard_core::ToolBalls>();
  tool->revision = 1;
  tool->pieces = {{{Eigen::Vector3d(0.01, 0.0, -0.003), 0.0}}};
  auto planes = std::make_shared<sweep_guard_core::PlaneSet>();
  planes->timestamps = {at.stamp, at.steady};
  planes->valid_until = at.stamp + std::chrono::milliseconds(100);
  planes->complete = true;
  planes->tool_revision = 1;
  planes->planes.push_back({0, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero(), -0.003, 0.0});
  sweep_guard_core::ForceInputs inputs;
  inputs.known.tool = tool;
  inputs.known.planes = planes;
  inputs.known.pose = sweep_guard_core::MotionInputs::ToolPose{Eigen::Isometry3d::Identity(), {at.stamp, at.steady}};
  inputs.known.warning =
      sweep_guard_core::MotionInputs::GuardWarning{sweep_guard_core::WarningLevel::kContact, 0, at.steady};
  return inputs;
}

// What is accepted makes forces that are finite, within their limits, and passive.
void useHaptics(const sweep_guard_ros::HapticsParameters& parameters) {
  sweep_guard_core::ForceRenderer renderer(parameters.force);
  sweep_guard_core::PassiveDevice device(parameters.force, parameters.hand);
  sweep_guard_core::DeviceWrench sent;
  for (int i = 1; i <= 20; ++i) {
    const sweep_guard_core::Duration time = std::chrono::seconds(100) + i * parameters.force.period;
    const sweep_guard_core::Instant at{sweep_guard_core::Time(time), sweep_guard_core::SteadyTime(time)};
    const sweep_guard_core::ForceInputs inputs = pressedBall(at);
    device.observe(
        {inputs.known.pose->X_WT, inputs.R_WD, parameters.force.position_scale, inputs.known.pose->timestamps}, at);
    sent = device.limit(renderer.render(inputs, sent, at).wrench, at.steady);
    require(sent.force_D.norm() <= parameters.force.max_force * (1.0 + 1e-9), "a force is within its limit");
    require(sent.torque_D.norm() <= parameters.force.max_torque * (1.0 + 1e-9), "a torque is within its limit");
    require(device.energy() <= device.tolerance() && device.turnEnergy() <= device.turnTolerance(),
            "a device is passive");
  }
}

const Target kParameters("parameters", [](Input input) {
  startRoscpp();
  serverParameters().clear();
  switch (input.below(4)) {
    case 3:
      checkStart(input, "/motion", sweep_guard_ros::loadMotionParameters, useMotion);
      break;
    case 2:
      checkStart(input, "/haptics", sweep_guard_ros::loadHapticsParameters, useHaptics);
      break;
    default:
      checkGuard(input);
  }
});

}  // namespace
}  // namespace sweep_guard_fuzz
