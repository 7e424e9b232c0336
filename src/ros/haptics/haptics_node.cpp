#include "ros/haptics/haptics_node.h"

#include <ros/console.h>

#include "ros/output/flush.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr auto kClockPeriod = std::chrono::milliseconds(20);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr size_t kMaxTransforms = 64 << 20;  // size of a message [bytes]

constexpr double kMaxJitter = 2e-4;  // p99 [s]

// Whatever the level: mergeSummary() drops what is said beside OK.
void addRemark(const std::string& remark, DiagnosticsLine& line) { line.message += "; " + remark; }

}  // namespace

HapticsNode::HapticsNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(loadHapticsParameters(private_node)),
      master_watch_(private_node, [this] { return parameters_.settings; }),
      supervisor_(process),
      frames_(node, kMaxTransforms, [](const std::string& /*parent*/, const std::string& /*child*/) {}),
      guard_(node, parameters_.guard, parameters_.tool),
      tool_pose_(node, parameters_.tool, frames_),
      axes_(frames_, parameters_.tool.fixed_frame, parameters_.device_frame),
      priority_(parameters_.realtime_priority, "realtime_priority"),
      cycle_(node, parameters_),
      output_watch_(cycle_.topic()),
      updater_(node, private_node, private_node.getNamespace()) {
  if (parameters_.joints.tree) joints_.emplace(node, parameters_);
  if (parameters_.device_tells_pose) device_pose_.emplace(node, parameters_.device(), frames_);
  updater_.setHardwareID("none");
  updater_.add("force", [this](DiagnosticsLine& line) { force(line); });
  updater_.add("output", [this](DiagnosticsLine& line) { output(line); });
  updater_.add("guard", [this](DiagnosticsLine& line) { guard_.report(line); });
  updater_.add("tool pose", [this](DiagnosticsLine& line) { reportPose(tool_pose_, "tool pose", line); });
  if (joints_) updater_.add("joints", [this](DiagnosticsLine& line) { joints_->input.report(line); });
  if (device_pose_) {
    updater_.add("device pose",
                 [this](DiagnosticsLine& line) { reportPose(*device_pose_, "pose of the device", line); });
  }
  forces_.every(ForceCycle::kPeriod, [this] { tick(); });
  reports_.every(kClockPeriod, [this] { frames_.checkClock(); });
  reports_.every(kDiagnosticsPeriod, [this] { updater_.force_update(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void HapticsNode::start() {
  frames_.start(supervisor_);
  guard_.start(supervisor_);
  tool_pose_.start(supervisor_);
  if (joints_) joints_->input.start(supervisor_);
  if (device_pose_) device_pose_->start(supervisor_, "device poses");
  forces_.start(supervisor_, {"forces", sweep_guard_core::Stage::kPublish}, [this] { priority_.make(); });
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  output_watch_.start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("forces of the surfaces around '%s' in '%s' go to %s along the axes of '%s', planes come from %s",
           parameters_.tool.frame.c_str(), parameters_.tool.fixed_frame.c_str(), cycle_.topic().c_str(),
           parameters_.device_frame.c_str(), parameters_.guard.c_str());
}

void HapticsNode::tick() {
  const sweep_guard_core::Instant at = now();
  sweep_guard_core::ForceInputs inputs;
  inputs.known = guard_.inputs();
  inputs.known.pose = tool_pose_.newest();
  inputs.placed = placedByJoints(inputs.known);
  const std::optional<Eigen::Matrix3d> R_WD = axes_.newest(at.stamp);
  if (R_WD) {
    inputs.R_WD = *R_WD;
  } else {
    inputs.known.warning.reset();
  }
  std::optional<sweep_guard_core::PassiveDevice::Hand> hand;
  if (device_pose_) {
    const auto device = device_pose_->newest();
    inputs.device = device ? device->timestamps : sweep_guard_core::Timestamps{};
    if (device) hand = {device->X_WT, Eigen::Matrix3d::Identity(), 1.0, device->timestamps};
  } else if (const auto& tool = inputs.known.pose) {
    hand = {tool->X_WT, inputs.R_WD, parameters_.force.position_scale, tool->timestamps};
  }
  cycle_.tick(inputs, hand, at);
}

std::optional<sweep_guard_core::PlacedByJoints> HapticsNode::placedByJoints(
    const sweep_guard_core::MotionInputs& known) {
  if (!joints_ || !known.pose || !known.planes || !known.tool) return {};
  auto& [input, measured, tool, at_rest] = *joints_;
  if (!isPlacedBy(*parameters_.joints.tree, *known.planes, *known.tool) || !input.newest(*known.planes, measured))
    return {};
  measured.state.X_WR = known.pose->X_WT;
  tool.place(measured.state, *known.tool, at_rest);
  return sweep_guard_core::PlacedByJoints{&tool, measured.timestamps};
}

HapticsNode::~HapticsNode() {
  forces_.stop();
  cycle_.stop();
  flush();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
}

void HapticsNode::force(DiagnosticsLine& line) {
  const ForceCycle::State state = cycle_.state();
  const sweep_guard_core::RenderedForce& rendered = state.rendered;
  const bool whole = rendered.permission.gain >= 1.0;
  line.summary(whole ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
               whole ? "sent" : std::string("zero: ") + textOf(rendered.permission.cause));
  if (rendered.stiffness_gain < 1.0) addRemark("softer, for the delay", line);
  const std::string problem = axes_.problem();
  if (!problem.empty()) {
    line.mergeSummary(DiagnosticStatus::ERROR, "device_frame: " + problem);
    log_.error("", "device_frame: " + problem);
  }
  line.addf("force [N]", "%.3f", state.sent.force_D.norm());
  line.addf("torque [N m]", "%.4f", state.sent.torque_D.norm());
  line.addf("depth [m]", "%.5f", rendered.depth);
  line.addf("delay that is counted on [s]", "%.4f", sweep_guard_core::toSeconds(rendered.delay));
  line.addf("share of the stiffness", "%.3f", rendered.stiffness_gain);
  line.addf("energy given by an axis, at most [J]", "%.6f", state.energy);
  line.addf("tolerance [J]", "%.6f", state.tolerance);
  if (!(state.turn_tolerance > 0.0)) return;
  line.addf("energy given about an axis, at most [J]", "%.6f", state.turn_energy);
  line.addf("tolerance about an axis [J]", "%.6f", state.turn_tolerance);
}

void HapticsNode::output(DiagnosticsLine& line) const {
  const std::vector<double> jitter = cycle_.ticks().jitter();
  const double p99 = sweep_guard_core::quantile(jitter, 0.99);
  reportOutput(output_watch_, cycle_.subscribers(), "haptics", "nothing is felt", line);
  if (p99 > kMaxJitter) line.mergeSummary(DiagnosticStatus::WARN, "late: the processor is busy");
  const std::string refusal = priority_.refusal();
  if (!refusal.empty()) addRemark(refusal, line);
  line.addf("jitter p99 [ms]", "%.3f", 1e3 * p99);
  line.addf("jitter, largest [ms]", "%.3f", 1e3 * sweep_guard_core::quantile(jitter, 1.0));
}

}  // namespace sweep_guard_ros
