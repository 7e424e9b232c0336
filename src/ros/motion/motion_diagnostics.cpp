#include "ros/motion/motion_diagnostics.h"

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
using sweep_guard_core::InputRecord;
using sweep_guard_core::toSeconds;

constexpr auto kSilent = std::chrono::seconds(1);

void addRecord(const std::string& name, const InputRecord::Summary& record, DiagnosticStatusWrapper& status) {
  const sweep_guard_core::Instant at = now();
  status.add(name + " received", record.received);
  status.add(name + " refused", record.refused);
  if (record.newest) status.addf(name + " age [s]", "%.3f", toSeconds(at.steady - record.newest->received));
  if (!record.last_error.empty()) status.add(name + " last error", record.last_error);
}

bool refusedLately(const InputRecord::Summary& record) {
  return record.refused > 0 && now().steady - record.error_time < kSilent;
}

bool silent(const InputRecord::Summary& record) {
  return !record.newest || now().steady - record.newest->received > kSilent;
}

}  // namespace

MotionDiagnostics::MotionDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                     const MotionDiagnosticsSources& sources)
    : sources_(sources), updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("motion", [this](Status& status) { motion(status); });
  updater_.add("command", [this](Status& status) { command(status); });
  updater_.add("output", [this](Status& status) { output(status); });
  updater_.add("guard", [this](Status& status) { guard(status); });
  updater_.add("tool pose", [this](Status& status) { toolPose(status); });
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
  const InputRecord::Summary record = sources_.cycle.record().summary();
  status.summary(DiagnosticStatus::OK, silent(record) ? "no command now" : "received");
  if (port.commandPublishers() == 0) status.summary(DiagnosticStatus::WARN, "no publisher on " + port.commandTopic());
  if (port.commandPublishers() > 1) {
    status.summary(DiagnosticStatus::WARN, "several publishers on " + port.commandTopic() + ": use a multiplexer");
  }
  status.add("topic", port.commandTopic());
  status.add("publishers", port.commandPublishers());
  status.addf("period that is counted on [s]", "%.4f", toSeconds(sources_.cycle.period()));
  addRecord("command", record, status);
}

void MotionDiagnostics::output(Status& status) const {
  const CommandPort& port = sources_.cycle.port();
  status.summary(DiagnosticStatus::OK, "only motion_guard publishes on " + port.guardedTopic());
  if (port.guardedSubscribers() == 0) {
    status.summary(DiagnosticStatus::WARN, "no subscriber to " + port.guardedTopic() + ": nothing is moved");
  }
  for (const std::string& other : sources_.output.otherPublishers()) {
    status.mergeSummary(DiagnosticStatus::ERROR, other + " publishes on " + port.guardedTopic() + ", past the guard");
  }
  status.add("topic", port.guardedTopic());
  status.add("subscribers", port.guardedSubscribers());
}

void MotionDiagnostics::guard(Status& status) const {
  status.summary(DiagnosticStatus::OK, "received");
  for (const auto& [topic, publishers, record] : sources_.guard.sources()) {
    if (!record.newest) status.mergeSummary(DiagnosticStatus::ERROR, "nothing received on " + topic);
    if (refusedLately(record)) status.mergeSummary(DiagnosticStatus::ERROR, topic + " refused: " + record.last_error);
    if (publishers > 1) status.mergeSummary(DiagnosticStatus::ERROR, "several publishers on " + topic);
    status.add(topic, std::to_string(publishers) + " publishers");
    addRecord(topic, record, status);
  }
}

void MotionDiagnostics::toolPose(Status& status) const {
  const InputRecord::Summary record = sources_.tool_pose.record().summary();
  status.summary(DiagnosticStatus::OK, "received");
  if (silent(record)) status.summary(DiagnosticStatus::ERROR, "no tool pose on " + sources_.tool_pose.source());
  if (refusedLately(record)) status.mergeSummary(DiagnosticStatus::ERROR, "refused: " + record.last_error);
  if (sources_.tool_pose.publishers().value_or(1) > 1) {
    status.mergeSummary(DiagnosticStatus::WARN, "several publishers: the tool jumps between their poses");
  }
  status.add("source", sources_.tool_pose.source());
  addRecord("tool pose", record, status);
}

}  // namespace sweep_guard_ros
