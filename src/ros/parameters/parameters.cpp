// The table of the guard's parameters, in the order of doc/interface.md and config/sweep_guard.yaml.
#include "ros/parameters/parameters.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/floating_point.h"
#include "common/number_text.h"
#include "ros/output/markers.h"
#include "ros/parameters/duration.h"
#include "ros/parameters/parameter_changes.h"
#include "ros/parameters/tool_parameters.h"
#include "ros/parameters/workpiece_parameters.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::kInfinity;
using sweep_guard_core::shortestText;
using sweep_guard_core::WarningThresholds;

constexpr double kMinStep = 0.001;        // [s]
constexpr size_t kBytesPerTriangle = 84;  // three indices and three vertices of a mesh that shares none
constexpr size_t kMebibyte = 1U << 20;
constexpr double kMaxHorizon = 5.0;  // [s]
constexpr double kMinProbability = 0.001;
constexpr double kShownProbability = 0.01;  // smaller ones are shown only if a warning depends on them
constexpr double kMaxStiffness = 1e12;      // [N/m^3]

sweep_guard_core::PredictorOptions readPredictor(ParameterReader& read) {
  const std::vector<std::string> axes = {"x", "y", "z", "rx", "ry", "rz"};
  sweep_guard_core::PredictorOptions options;
  options.predictor =
      read.live().choice("prediction/predictor", options.predictor, sweep_guard_core::predictorNames(),
                         "direct: learns the displacement within each horizon from the operator's velocities. "
                         "polynomial: one per axis. constant_velocity: the newest velocity. hold: no motion.");
  const std::vector<int> degree = read.live().integers(
      "prediction/degree", {options.degree.begin(), options.degree.end()}, 0, 5,
      "polynomial only: degree along x y z of the fixed frame, then about x y z of the tool; of joints, the largest.");
  std::copy(degree.begin(), degree.end(), options.degree.begin());
  for (const std::string& axis : read.live().selection(
           "prediction/constrained", axes, "Axes that the operator cannot move: predicted to stay. Not of joints.")) {
    options.constrained[static_cast<size_t>(std::find(axes.begin(), axes.end(), axis) - axes.begin())] = true;
  }
  options.forgetting_factor =
      read.live().number("prediction/forgetting_factor", options.forgetting_factor, {0.01, 1.0},
                         "Weight of a sample relative to the next one. Smaller follows turns sooner.");
  options.window = toDuration(read.live().number("prediction/window", sweep_guard_core::toSeconds(options.window),
                                                 {0.02, 10.0, "s"}, "Polynomials ignore older samples."));
  options.max_speed = read.live().number(
      "limits/max_speed", options.max_speed, {0.001, 1000.0, "m/s"},
      "Largest predicted speed of the tip or a sliding joint. A faster pose is a JUMP: the motion is learned again.");
  options.max_turn_rate =
      read.live().number("limits/max_turn_rate", options.max_turn_rate, {0.001, 1000.0, "rad/s"},
                         "Largest predicted turn rate of the tool or a joint. A pose that turns faster is a JUMP.");
  return options;
}

sweep_guard_core::InteractionOptions readInteraction(ParameterReader& read) {
  sweep_guard_core::InteractionOptions options;
  sweep_guard_core::ForceLaw& law = options.law;
  law.stiffness = read.live().number("interaction/stiffness", law.stiffness, {0.0, kMaxStiffness, "N/m^3"},
                                     "~interaction: force per volume that tool and workpiece share.");
  for (const auto& [id, stiffness] :
       read.numbers("interaction/stiffness_of", "~interaction: stiffness [N/m^3] by workpiece, 0 to 1e12.",
                    ParameterReader::Range{0.0, kMaxStiffness, "N/m^3"})) {
    options.stiffness_of[id] = stiffness;
    options.stiffness_of.emplace("/" + id, stiffness);  // YAML's key of an id with a slash at its front has none
  }
  law.damping =
      read.live().number("interaction/damping", law.damping, {0.0, 1000.0, "s/m"},
                         "~interaction: share by which the force grows per closing speed, and shrinks on the way out.");
  law.least_area = read.live().number(
      "interaction/min_area", law.least_area, {1e-12, 1.0, "m^2"},
      "~interaction: below this integral of the surface's normal inside the tool, the force shrinks in proportion.");
  return options;
}

sweep_guard_core::HorizonOptions readHorizon(ParameterReader& read, Duration pose_timeout) {
  const ParameterReader::Range any{kMinStep, kMaxHorizon, "s"};
  const double reflex = read.live().number("horizon/reflex", 0.1, {0.01, 1.0, "s"},
                                           "A collision predicted within this time from now raises REFLEX.");
  const double reflex_step = read.live().number(
      "horizon/reflex_step", 0.01, any, "Duration of a predicted sweep within horizon/reflex, and at most that.",
      ParameterReader::Range{kMinStep, reflex, "", "at most horizon/reflex"});
  const double considered = read.live().number(
      "horizon/considered", 1.0, any,
      "A collision predicted within this time from now raises CONSIDERED. Later than horizon/reflex.",
      ParameterReader::Range{reflex + kMinStep, kMaxHorizon, "", "later than horizon/reflex"});
  const double considered_step = read.live().number(
      "horizon/considered_step", 0.1, any,
      "Duration of a predicted sweep after horizon/reflex, at most to horizon/considered. Longer where the detector is "
      "too slow for timing/min_rate.",
      ParameterReader::Range{kMinStep, considered - reflex, "", "at most horizon/considered less horizon/reflex"});
  return {toDuration(reflex), toDuration(reflex_step), toDuration(considered), toDuration(considered_step),
          pose_timeout};
}

// @param thresholds  of the keys that are not set
WarningThresholds readThresholds(ParameterReader& read, WarningThresholds thresholds = {}) {
  const ParameterReader::Range any{kMinProbability, 1.0};
  thresholds.considered_on =
      read.live().number("warning/considered_on", thresholds.considered_on, any,
                         "Probability from which a contact off the predicted path within horizon/considered raises "
                         "CONSIDERED. Smaller warns earlier, with more false alarms.");
  thresholds.considered_off = read.live().number(
      "warning/considered_off", std::min(thresholds.considered_off, thresholds.considered_on), any,
      "Probability down to which such a contact keeps CONSIDERED; at most warning/considered_on.",
      ParameterReader::Range{kMinProbability, thresholds.considered_on, "", "at most warning/considered_on"});
  thresholds.reflex = read.live().number(
      "warning/reflex_probability", thresholds.reflex, any,
      "Probability from which a contact off the predicted path within horizon/reflex raises REFLEX.");
  return thresholds;
}

// Ignored, it would make the guard warn otherwise than it was configured to.
void refuseMinProbability(const ros::NodeHandle& private_node) {
  const std::string key = "warning/min_probability";
  XmlRpc::XmlRpcValue value;
  if (!private_node.getParam(key, value)) return;
  ParameterReader read(private_node);
  const double all = read.number(key, 1.0, {kMinProbability, 1.0});
  const auto [reflex, on, off] = readThresholds(read, WarningThresholds::ofMinProbability(all));
  throw sweep_guard_core::InvalidInput(
      "parameter " + private_node.resolveName(key) + " has been replaced by three: remove it, and set " +
      "warning/considered_on: " + shortestText(on) + ", warning/considered_off: " + shortestText(off) +
      ", warning/reflex_probability: " + shortestText(reflex) + " to be warned as by " + shortestText(all));
}

// What is farther off the predicted path raises or keeps no warning, and is not worth showing.
double maxDeviations(const WarningThresholds& thresholds) {
  const auto deviations = [](sweep_guard_core::PredictionInterval interval, double threshold) {
    return sweep_guard_core::deviationsAt(interval, std::min(kShownProbability, threshold));
  };
  using sweep_guard_core::PredictionInterval;
  return std::max(deviations(PredictionInterval::kReflex, thresholds.reflex),
                  deviations(PredictionInterval::kConsidered, thresholds.considered_off));
}

Parameters readAll(ParameterReader& read, const Parameters* before) {
  Parameters parameters;
  parameters.fixed_frame = read.name("fixed_frame", "world", "tf frame in which motion is measured.");
  const std::string source = read.choice("tool_source", "topic", {"topic", "tf", "joint_states"},
                                         "topic: poses on `tool_pose`. tf: the frame tool_frame. joint_states: joints "
                                         "move the tool, and tf has tool_frame, which carries them.");
  const std::map<std::string, ToolSource> sources = {
      {"topic", ToolSource::kTopic}, {"tf", ToolSource::kTf}, {"joint_states", ToolSource::kJointStates}};
  parameters.tool_source = sources.at(source);
  parameters.tool_frame =
      read.name("tool_frame", "tool",
                "tf frame of the tool, and its name in messages. urdf: the link that poses are of, in tf maybe with a "
                "prefix; `tool`: the first of tool/links or, with joint_states, the root.");
  readTool(read, before, parameters);
  parameters.detector.name =
      read.live().choice("detector", "select", sweep_guard_core::detectorNames(),
                         "select: OpenGL selection off screen. halfspace: the same test on vector units, the fastest. "
                         "reference: clips every triangle in double precision, slow.");
  parameters.detector.options.cull =
      read.live().flag("cull", true, "select only: leaves out triangles wholly beyond one plane of the volume.");
  std::vector<std::string> gl_contexts = sweep_guard_core::offscreenContextNames();
  gl_contexts.insert(gl_contexts.begin(), sweep_guard_core::kAnyGlContext);
  parameters.detector.options.gl_context =
      read.choice("gl_context", gl_contexts.front(), gl_contexts,
                  "select only: Mesa's library for OpenGL (no OSMesa from Mesa 25.1 on). auto: osmesa, else egl, else "
                  "detector halfspace. osmesa, egl: without it the node ends.");
  const std::string self_test = read.choice(
      "self_test", "unknown", {"unknown", "exit", "none"},
      "If the detector fails its test at the start: unknown: never CLEAR. exit: the node ends. none: no test.");
  const std::map<std::string, SelfTest> self_tests = {
      {"unknown", SelfTest::kUnknown}, {"exit", SelfTest::kExit}, {"none", SelfTest::kNone}};
  parameters.self_test = self_tests.at(self_test);
  parameters.cross_check = read.integer("cross_check", 100, 0, 1000000,
                                        "Another detector answers one of so many queries again, in spare time. If they "
                                        "disagree, both answers count. 0: none.");
  parameters.guard.sweep.fine = read.live().flag(
      "fine", true,
      "Rules out triangles that are missed, and says when, where and how deep the tool touches the others.");
  parameters.guard.sweep.volume = sweep_guard_core::volumeKind(
      read.live().choice("volume", "obb_planes", {"obb", "obb_planes", "hull"},
                         "Volume around the tool at two poses. obb: oriented box. obb_planes: box cut by four planes, "
                         "tighter. hull: convex hull, tightest, slower."));
  parameters.guard.sweep.max_rotation =
      read.live().number("max_rotation_per_sweep", 0.175, {0.01, 0.5, "rad"},
                         "A motion that turns more is swept in steps. Smaller: tighter and slower.");
  parameters.limits.thresholds = readThresholds(read);
  parameters.guard.max_deviations = maxDeviations(parameters.limits.thresholds);
  parameters.limits.hold_time = toDuration(read.live().number(
      "warning/hold_time", 0.5, {0.0, 60.0, "s"}, "A warning stays for this long after its cause is over."));
  parameters.limits.acknowledge_time =
      toDuration(read.live().number("warning/acknowledge_time", 10.0, {0.1, 60.0, "s"},
                                    "An acknowledgement (~acknowledge) lasts for this long at most."));
  parameters.limits.min_seen = readMinSeen(read, parameters.limits.min_seen);
  parameters.acknowledge_distance =
      read.live().number("warning/acknowledge_distance", 0.03, {0.0, 1.0, "m"},
                         "An acknowledgement lasts while the tool, grown by this, meets the workpiece.");
  parameters.proximity_reach =
      read.live().number("proximity/reach", 0.1, {0.0, 10.0, "m"},
                         "~proximity has planes for all surfaces nearer than this; 0: it is not published.");
  parameters.interaction = readInteraction(read);
  parameters.joint_timeout =
      toDuration(read.live().number("timing/pose_timeout", 0.1, {0.01, 2.0, "s"},
                                    "An older tool pose makes the warning UNKNOWN. So does a transform of a workpiece "
                                    "that moves, if older by more than its period."));
  parameters.limits.pose_timeout = parameters.joint_timeout;
  for (const auto& [joint, timeout] : parameters.joint_timeouts)
    parameters.limits.pose_timeout = std::max(parameters.limits.pose_timeout, timeout);
  parameters.limits.mesh_timeout = toDuration(read.live().number(
      "timing/mesh_timeout", 0.5, {0.01, kInfinity, "s"},
      "An older workpiece makes the warning UNKNOWN. .inf (inf on a command line): workpieces do not age."));
  parameters.guard.predictor = readPredictor(read);
  readCommandSource(read, parameters);
  parameters.guard.horizon = readHorizon(read, parameters.limits.pose_timeout);
  parameters.limits.reflex = parameters.guard.horizon.reflex;
  parameters.limits.considered = parameters.guard.horizon.considered;
  parameters.guard.cycle =
      toDuration(1.0 / read.live().number("timing/min_rate", 15.0, {1.0, 1000.0, "Hz"},
                                          "Poses are swept, and the path ahead is tested, at least this "
                                          "often."));
  parameters.marker_rate =
      read.live().number("timing/marker_rate", 15.0, {0.1, 100.0, "Hz"}, "Highest rate of ~markers and ~cameras/ID.");
  for (const std::string& name : markerNamespaces()) {
    const std::string bound = name == "workpieces" ? " Beyond " + std::to_string(kMaxMarkedTriangles) +
                                                         " triangles in all, a text takes its place."
                                                   : "";
    if (read.live().flag("markers/" + name, true, "Publishes this namespace of ~markers." + bound))
      parameters.marker_namespaces.insert(name);
  }
  parameters.check_sweep_deadline = toDuration(read.live().number(
      "check_sweep/deadline", 1.0, {0.01, 60.0, "s"}, "~check_sweep and ~check_trajectory give up after this time."));
  parameters.realtime_priority = read.integer(
      "timing/realtime_priority", 0, 0, 99,
      "SCHED_FIFO priority of the sweeping thread; 0: none. If the system refuses, the log says what to set.");
  const std::vector<std::string> ids = read.texts(
      "mesh_ids", "Workpieces without which the warning is not CLEAR; others are ignored. []: all that come.");
  parameters.mesh_ids.insert(ids.begin(), ids.end());
  readWorkpieces(read, parameters);
  if (!parameters.cameras.empty()) readRobotLinks(read, before, parameters);
  parameters.other_tools = read.nodes("other_tools",
                                      "Guards of other tools, as [/left/sweep_guard]: their links are workpieces. One "
                                      "that is silent for timing/pose_timeout makes the warning UNKNOWN.");
  parameters.allow_several_publishers =
      read.flag("allow_several_publishers", false,
                "Allows several publishers of `tool_pose`, and of tf frames that place the tool or a workpiece. "
                "Otherwise they make the warning UNKNOWN.");
  parameters.max_triangles = static_cast<size_t>(
      read.integer("limits/max_triangles", 1000000, 1, 10000000, "A mesh with more triangles is refused."));
  const int max_message_size =
      read.integer("limits/max_message_size", 0, 0, std::numeric_limits<int>::max(),
                   "[bytes] A longer message is refused unread. 0: 84 for each of limits/max_triangles, and 1 MiB.");
  parameters.max_message_size = max_message_size > 0 ? static_cast<size_t>(max_message_size)
                                                     : kBytesPerTriangle * parameters.max_triangles + kMebibyte;
  parameters.max_memory =
      static_cast<size_t>(read.integer("limits/memory", 4096, 0, 1 << 24,
                                       "[MiB] Address space of the process; what does not fit is refused. 0: no limit. "
                                       "A nodelet leaves it to its manager."));
  read.number("diagnostic_period", 1.0, {0.0, kInfinity});  // set by diagnostic_updater
  parameters.settings = read.settings();
  parameters.described = read.described();
  if (before != nullptr && !detectorsDiffer(*before, parameters)) parameters.detector = before->detector;
  return parameters;
}

}  // namespace

std::set<std::string> cameraIds(const Parameters& parameters) {
  std::set<std::string> ids;
  for (const CameraParameters& camera : parameters.cameras) ids.insert(camera.id);
  return ids;
}

std::set<std::string> requiredIds(const Parameters& parameters) {
  std::set<std::string> ids = cameraIds(parameters);
  ids.insert(parameters.mesh_ids.begin(), parameters.mesh_ids.end());
  return ids;
}

std::shared_ptr<const sweep_guard_core::Robot> articulatedRobot(const Parameters& parameters) {
  if (!parameters.articulated) return nullptr;
  return {parameters.robot, &parameters.robot->robot};
}

Parameters loadParameters(const ros::NodeHandle& private_node) {
  refuseMinProbability(private_node);
  ParameterReader read(private_node);
  Parameters parameters = readAll(read, nullptr);
  read.warnOfUnread();
  return parameters;
}

void checkConfigured(const ros::NodeHandle& private_node, const std::vector<std::string>& arguments) {
  const bool configured = std::count(arguments.begin(), arguments.end(), "--configured") != 0;
  if (!configured || private_node.hasParam("")) return;
  throw sweep_guard_core::InvalidInput("there is no parameter in " + private_node.getNamespace() +
                                       ": the master was started anew and has lost them; start the launch file again");
}

Parameters changeParameters(const ros::NodeHandle& private_node, const Parameters& before,
                            const std::map<std::string, ParameterValue>& changes) {
  ParameterReader::Settings settings = before.settings;
  for (const auto& [key, value] : changes) {
    const std::string name = private_node.resolveName(key);
    if (settings.count(key) == 0) throw sweep_guard_core::InvalidInput("there is no parameter " + name);
    const auto is_live = [&, key = key](const ParameterInfo& info) { return info.key == key && info.live; };
    if (std::none_of(before.described.begin(), before.described.end(), is_live)) {
      throw sweep_guard_core::InvalidInput("parameter " + name + " does not change while the guard runs: restart it");
    }
    std::visit([&, key = key](const auto& held) { settings[key] = XmlRpc::XmlRpcValue(held); }, value);
  }
  ParameterReader read(private_node, std::move(settings));
  return readAll(read, &before);
}

}  // namespace sweep_guard_ros
