#include "ros/haptics/haptics_diagnostics.h"

#include "ros/motion/input_diagnostics.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kMaxJitter = 2e-4;  // p99 [s]

// Whatever the level: mergeSummary() drops what is said beside OK.
void addRemark(const std::string& remark, diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.message += "; " + remark;
}

}  // namespace

HapticsDiagnostics::HapticsDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                       const HapticsDiagnosticsSources& sources)
    : sources_(sources), updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("force", [this](Status& status) { force(status); });
  updater_.add("output", [this](Status& status) { output(status); });
  updater_.add("guard", [this](Status& status) { reportGuard(sources_.guard, status); });
  updater_.add("tool pose", [this](Status& status) { reportPose(sources_.tool, "tool pose", status); });
  if (sources_.device == nullptr) return;
  updater_.add("device pose", [this](Status& status) { reportPose(*sources_.device, "pose of the device", status); });
}

void HapticsDiagnostics::force(Status& status) {
  const ForceCycle::State state = sources_.cycle.state();
  const sweep_guard_core::RenderedForce& rendered = state.rendered;
  const bool whole = rendered.permission.gain >= 1.0;
  status.summary(whole ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 whole ? "sent" : std::string("zero: ") + textOf(rendered.permission.cause));
  if (rendered.stiffness_gain < 1.0) addRemark("softer, for the delay", status);
  const std::string problem = sources_.axes.problem();
  if (!problem.empty()) {
    status.mergeSummary(DiagnosticStatus::ERROR, "device_frame: " + problem);
    log_.error("", "device_frame: " + problem);
  }
  status.addf("force [N]", "%.3f", state.sent.force_D.norm());
  status.addf("torque [N m]", "%.4f", state.sent.torque_D.norm());
  status.addf("depth [m]", "%.5f", rendered.depth);
  status.addf("delay that is counted on [s]", "%.4f", sweep_guard_core::toSeconds(rendered.delay));
  status.addf("share of the stiffness", "%.3f", rendered.stiffness_gain);
  status.addf("energy given by an axis, at most [J]", "%.6f", state.energy);
  status.addf("tolerance [J]", "%.6f", state.tolerance);
  if (!(state.turn_tolerance > 0.0)) return;
  status.addf("energy given about an axis, at most [J]", "%.6f", state.turn_energy);
  status.addf("tolerance about an axis [J]", "%.6f", state.turn_tolerance);
}

void HapticsDiagnostics::output(Status& status) const {
  const TickRecord::Summary ticks = sources_.cycle.ticks().summary();
  reportOutput(sources_.output, {sources_.cycle.topic(), sources_.cycle.subscribers(), "haptics", "nothing is felt"},
               status);
  if (ticks.p99 > kMaxJitter) status.mergeSummary(DiagnosticStatus::WARN, "late: the processor is busy");
  const std::string refusal = sources_.priority.refusal();
  if (!refusal.empty()) addRemark(refusal, status);
  status.addf("jitter p99 [ms]", "%.3f", 1e3 * ticks.p99);
  status.addf("jitter, largest [ms]", "%.3f", 1e3 * ticks.largest);
}

}  // namespace sweep_guard_ros
