#include "sweep_guard/ros/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/offscreen_context.h"
#include "sweep_guard/ros/markers.h"
#include "sweep_guard/ros/tool_model.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Duration;
using sweep_guard::toSeconds;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kShortestStep = 0.001;   // [s]
constexpr double kFarthestHorizon = 5.0;  // [s]

// What may change while the guard runs: tools, topics and devices stay what they were made as.
const std::vector<std::string> kTunable = {"tool/padding",
                                           "volume",
                                           "detector",
                                           "cull",
                                           "fine",
                                           "max_rotation_per_sweep",
                                           "prediction/predictor",
                                           "prediction/degree",
                                           "prediction/constrained",
                                           "prediction/forgetting_factor",
                                           "prediction/window",
                                           "horizon/reflex",
                                           "horizon/reflex_step",
                                           "horizon/considered",
                                           "horizon/considered_step",
                                           "warning/min_probability",
                                           "warning/hold_time",
                                           "timing/min_rate",
                                           "timing/pose_timeout",
                                           "timing/mesh_timeout",
                                           "timing/marker_rate",
                                           "limits/max_speed",
                                           "limits/max_turn_rate"};
const std::string kMarkers = "markers/";

Duration duration(double seconds) { return std::isinf(seconds) ? Duration::max() : sweep_guard::fromSeconds(seconds); }

sweep_guard::PredictorOptions readPredictor(ParameterReader& read) {
  const std::vector<std::string> axes = {"x", "y", "z", "rx", "ry", "rz"};
  sweep_guard::PredictorOptions options;
  options.predictor = read.choice("prediction/predictor", options.predictor, sweep_guard::predictorNames());
  const std::vector<int> degree =
      read.integers("prediction/degree", {options.degree.begin(), options.degree.end()}, 0, 5);
  std::copy(degree.begin(), degree.end(), options.degree.begin());
  for (const std::string& axis : read.selection("prediction/constrained", axes)) {
    options.constrained[static_cast<size_t>(std::find(axes.begin(), axes.end(), axis) - axes.begin())] = true;
  }
  options.forgetting_factor = read.number("prediction/forgetting_factor", options.forgetting_factor, {0.01, 1.0});
  options.window = duration(read.number("prediction/window", toSeconds(options.window), {0.02, 10.0, "s"}));
  options.max_speed = read.number("limits/max_speed", options.max_speed, {0.001, 1000.0, "m/s"});
  options.max_turn_rate = read.number("limits/max_turn_rate", options.max_turn_rate, {0.001, 1000.0, "rad/s"});
  return options;
}

sweep_guard::HorizonOptions readHorizon(ParameterReader& read, Duration pose_timeout) {
  const ParameterReader::Range any{kShortestStep, kFarthestHorizon, "s"};
  const double reflex = read.number("horizon/reflex", 0.1, {0.01, 1.0, "s"});
  const double reflex_step = read.number("horizon/reflex_step", 0.01, any,
                                         ParameterReader::Bound{{kShortestStep, reflex}, "at most horizon/reflex"});
  const double considered =
      read.number("horizon/considered", 1.0, any,
                  ParameterReader::Bound{{reflex + kShortestStep, kFarthestHorizon}, "later than horizon/reflex"});
  const double considered_step = read.number(
      "horizon/considered_step", 0.1, any,
      ParameterReader::Bound{{kShortestStep, considered - reflex}, "at most horizon/considered less horizon/reflex"});
  return {duration(reflex), duration(reflex_step), duration(considered), duration(considered_step), pose_timeout};
}

// What a cylinder is made of is checked for a tool of another type, too.
sweep_guard::Tool readCylinder(ParameterReader& read, double padding) {
  const double radius = read.number("tool/radius", 0.01, {1e-6, 100.0});
  const double length = read.number("tool/length", 0.15, {1e-6, 100.0});
  const int sides = read.integer("tool/sides", 32, 3, 1000);
  return sweep_guard::Tool(sweep_guard::ConvexShape::cylinder(radius, length, sides).padded(padding));
}

ToolModelOptions readModelOptions(ParameterReader& read, const std::string& frame, double padding) {
  ToolModelOptions options;
  options.frame = frame;
  options.padding = padding;
  options.links = read.texts("tool/links");
  options.mesh_depth = read.integer("tool/mesh_depth", options.mesh_depth, 0, 16);
  options.joints = read.numbers("tool/joints");
  options.mesh_roots = read.texts("tool/mesh_roots");
  read.refuseIfSet("tool/joint_states",
                   "a tool that changes its shape while it moves is not supported; set tool/joints");
  return options;
}

std::string told(const ToolModel& model, const std::string& parameter) {
  std::ostringstream text;
  text << model.parts.size() << " parts from " << parameter << " in the frame of '" << model.frame << "'";
  for (const auto& [joint, position] : model.held) text << ", joint '" << joint << "' at " << position;
  return text.str();
}

sweep_guard::Tool toolFromRobot(ParameterReader& read, const std::string& parameter, const ToolModelOptions& options,
                                std::string& story) {
  const std::string urdf = read.textAbove(parameter);
  if (urdf.empty()) {
    throw sweep_guard::InvalidInput("tool/type is urdf, but there is no robot description in the parameter '" +
                                    parameter + "': load one, or name it in tool/robot_description");
  }
  try {
    ToolModel model = loadToolModel(urdf, options);
    story = told(model, parameter);
    return sweep_guard::Tool(std::move(model.parts));
  } catch (const sweep_guard::InvalidInput& error) {
    throw sweep_guard::InvalidInput("no tool from the parameter '" + parameter + "': " + error.what());
  }
}

// @param before  has the same tool, but for its padding; null: there is none yet
void readTool(ParameterReader& read, const Parameters* before, Parameters& parameters) {
  const std::string type = read.choice("tool/type", "cylinder", {"cylinder", "urdf"});
  const double padding = read.number("tool/padding", 0.0, {0.0, 1.0, "m"});
  const sweep_guard::Tool cylinder = readCylinder(read, padding);
  const std::string description = read.name("tool/robot_description", "robot_description");
  const ToolModelOptions options = readModelOptions(read, parameters.tool_frame, padding);
  parameters.tool_padding = padding;
  if (before != nullptr && before->tool_padding == padding) {
    parameters.tool = before->tool;
    parameters.tool_story = before->tool_story;
    return;
  }
  parameters.tool_story = "a cylinder";
  parameters.tool = std::make_shared<const sweep_guard::Tool>(
      type == "urdf" ? toolFromRobot(read, description, options, parameters.tool_story) : cylinder);
}

Parameters readAll(ParameterReader& read, const Parameters* before) {
  Parameters parameters;
  parameters.fixed_frame = read.name("fixed_frame", "world");
  parameters.tool_source =
      read.choice("tool_source", "topic", {"topic", "tf"}) == "tf" ? ToolSource::kTf : ToolSource::kTopic;
  parameters.tool_frame = read.name("tool_frame", "tool");
  readTool(read, before, parameters);
  parameters.detector = read.choice("detector", "select", sweep_guard::detectorNames());
  parameters.detector_options.cull = read.flag("cull", true);
  parameters.detector_options.gl_context = read.choice("gl_context", "osmesa", sweep_guard::offscreenContextNames());
  parameters.detector_story = parameters.detector;
  if (parameters.detector == "select") parameters.detector_story += " on " + parameters.detector_options.gl_context;
  if (parameters.detector == "halfspace")
    parameters.detector_story += std::string(" on ") + sweep_guard::simd::kernels().name;
  parameters.guard.sweep.fine = read.flag("fine", true);
  parameters.guard.sweep.volume =
      sweep_guard::volumeKind(read.choice("volume", "obb_planes", {"obb", "obb_planes", "hull"}));
  parameters.guard.sweep.max_rotation = read.number("max_rotation_per_sweep", 0.175, {0.01, 0.5, "rad"});
  parameters.limits.min_probability = read.number("warning/min_probability", 0.1, {0.001, 1.0});
  parameters.limits.hold_time = duration(read.number("warning/hold_time", 0.5, {0.0, 60.0, "s"}));
  parameters.limits.pose_timeout = duration(read.number("timing/pose_timeout", 0.1, {0.01, 2.0, "s"}));
  parameters.limits.mesh_timeout = duration(read.number("timing/mesh_timeout", 0.5, {0.01, kInfinity, "s"}));
  parameters.guard.predictor = readPredictor(read);
  parameters.guard.horizon = readHorizon(read, parameters.limits.pose_timeout);
  parameters.limits.reflex = parameters.guard.horizon.reflex;
  parameters.limits.considered = parameters.guard.horizon.considered;
  parameters.guard.cycle = duration(1.0 / read.number("timing/min_rate", 15.0, {1.0, 1000.0, "Hz"}));
  parameters.marker_rate = read.number("timing/marker_rate", 15.0, {0.1, 100.0, "Hz"});
  for (const std::string& part : markerNamespaces()) {
    if (read.flag(kMarkers + part, true)) parameters.marker_namespaces.insert(part);
  }
  parameters.realtime_priority = read.integer("timing/realtime_priority", 0, 0, 99);
  parameters.max_triangles = static_cast<size_t>(read.integer("limits/max_triangles", 1000000, 1, 10000000));
  read.number("diagnostic_period", 1.0, {0.0, kInfinity});  // diagnostic_updater leaves it there
  parameters.settings = read.settings();
  parameters.described = read.described();
  return parameters;
}

}  // namespace

Parameters loadParameters(const ros::NodeHandle& private_node) {
  ParameterReader read(private_node);
  Parameters parameters = readAll(read, nullptr);
  read.warnOfUnread();
  return parameters;
}

bool changesWhileRunning(const std::string& key) {
  return std::count(kTunable.begin(), kTunable.end(), key) != 0 || key.compare(0, kMarkers.size(), kMarkers) == 0;
}

Parameters changeParameters(const ros::NodeHandle& private_node, const Parameters& before,
                            const std::map<std::string, ParameterValue>& changes) {
  ParameterReader::Settings settings = before.settings;
  for (const auto& [key, value] : changes) {
    const std::string name = private_node.resolveName(key);
    if (settings.count(key) == 0) throw sweep_guard::InvalidInput("there is no parameter " + name);
    if (!changesWhileRunning(key)) {
      throw sweep_guard::InvalidInput("parameter " + name + " does not change while the guard runs: restart it");
    }
    std::visit([&, key = key](const auto& held) { settings[key] = XmlRpc::XmlRpcValue(held); }, value);
  }
  ParameterReader read(private_node, std::move(settings));
  return readAll(read, &before);
}

std::vector<ParameterChange> differences(const Parameters& before, const Parameters& after) {
  std::vector<ParameterChange> changes;
  for (size_t i = 0; i < after.described.size(); ++i) {
    const ParameterInfo& was = before.described[i];
    const ParameterInfo& is = after.described[i];
    if (was.value != is.value) changes.push_back({is.key, was.value, is.value});
  }
  return changes;
}

bool differ(const Parameters& before, const Parameters& after, const std::string& beginning) {
  const std::vector<ParameterChange> changes = differences(before, after);
  return std::any_of(changes.begin(), changes.end(), [&](const ParameterChange& change) {
    return change.key.compare(0, beginning.size(), beginning) == 0;
  });
}

bool detectorsDiffer(const Parameters& before, const Parameters& after) {
  return differ(before, after, "detector") || differ(before, after, "cull");
}

LiveParameters::LiveParameters(Parameters initial)
    : initial_(std::make_shared<const Parameters>(std::move(initial))), current_(initial_) {}

std::shared_ptr<const Parameters> LiveParameters::get() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

void LiveParameters::set(std::shared_ptr<const Parameters> parameters) {
  const std::lock_guard lock(mutex_);
  std::swap(current_, parameters);
}

}  // namespace sweep_guard_ros
