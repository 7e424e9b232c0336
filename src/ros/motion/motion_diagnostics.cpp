#include "ros/motion/motion_diagnostics.h"

#include "ros/motion/input_diagnostics.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

}  // namespace

MotionDiagnostics::MotionDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                     const MotionDiagnosticsSources& sources)
    : sources_(sources), updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("motion", [this](Status& status) { motion(status); });
  updater_.add("command", [this](Status& status) { command(status); });
  updater_.add("output", [this](Status& status) { output(status); });
  updater_.add("guard", [this](Status& status) { reportGuard(sources_.guard, status); });
  updater_.add("tool pose", [this](Status& status) { reportPose(sources_.tool_pose, "tool pose", status); });
}

void MotionDiagnostics::motion(Status& status) const {
  const sweep_guard::MotionStatus newest = sources_.status.newest();
  const bool stopped =
      newest.code == sweep_guard::MotionStatus::HALT_FOR_COLLISION || newest.code == sweep_guard::MotionStatus::INVALID;
  status.summary(stopped ? DiagnosticStatus::WARN : DiagnosticStatus::OK, newest.text);
  status.add("code", static_cast<int>(newest.code));
  status.addf("scale", "%.3f", newest.scale);
  status.addf("age of planes [s]", "%.3f", newest.planes_age);
  for (const auto& [cause, count] : sources_.status.counts()) status.add("began: " + cause, count);
}

void MotionDiagnostics::command(Status& status) const {
  const CommandPort& port = sources_.cycle.port();
  const sweep_guard_core::InputRecord::Summary record = sources_.cycle.record().summary();
  status.summary(DiagnosticStatus::OK, silent(record) ? "no command now" : "received");
  const std::string rarity = sources_.cycle.rarity();
  if (!rarity.empty()) status.summary(DiagnosticStatus::WARN, rarity);
  if (port.commandPublishers() == 0) status.summary(DiagnosticStatus::WARN, "no publisher on " + port.commandTopic());
  if (port.commandPublishers() > 1) {
    status.summary(DiagnosticStatus::WARN, "several publishers on " + port.commandTopic() + ": use a multiplexer");
  }
  status.add("topic", port.commandTopic());
  status.add("publishers", port.commandPublishers());
  status.addf("period that is counted on [s]", "%.4f", sweep_guard_core::toSeconds(sources_.cycle.period()));
  addRecord("command", record, status);
}

void MotionDiagnostics::output(Status& status) const {
  const CommandPort& port = sources_.cycle.port();
  reportOutput(sources_.output, {port.guardedTopic(), port.guardedSubscribers(), "motion_guard", "nothing is moved"},
               status);
}

}  // namespace sweep_guard_ros
