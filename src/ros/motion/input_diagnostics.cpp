#include "ros/motion/input_diagnostics.h"

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard_core::InputRecord;
using sweep_guard_core::toSeconds;

constexpr auto kSilent = std::chrono::seconds(1);

bool refusedLately(const InputRecord::Summary& record) {
  return record.refused > 0 && now().steady - record.error_time < kSilent;
}

}  // namespace

void addRecord(const std::string& name, const InputRecord::Summary& record, DiagnosticsLine& line) {
  const sweep_guard_core::Instant at = now();
  line.add(name + " received", record.received);
  line.add(name + " refused", record.refused);
  if (record.newest) line.addf(name + " age [s]", "%.3f", toSeconds(at.steady - record.newest->received));
  if (!record.last_error.empty()) line.add(name + " last error", record.last_error);
}

bool silent(const InputRecord::Summary& record) {
  return !record.newest || now().steady - record.newest->received > kSilent;
}

void reportTopic(const BoundedSubscriber& subscriber, const InputRecord::Summary& record, bool expected,
                 DiagnosticsLine& line) {
  const std::string topic = subscriber.getTopic();
  const std::uint32_t publishers = subscriber.getNumPublishers();
  if (expected && !record.newest) line.mergeSummary(DiagnosticStatus::ERROR, "nothing received on " + topic);
  if (refusedLately(record)) line.mergeSummary(DiagnosticStatus::ERROR, topic + " refused: " + record.last_error);
  if (publishers > 1) line.mergeSummary(DiagnosticStatus::ERROR, "several publishers on " + topic);
  line.add(topic, std::to_string(publishers) + " publishers");
  addRecord(topic, record, line);
}

void reportPose(const ToolPoseInput& pose, const std::string& name, DiagnosticsLine& line) {
  const InputRecord::Summary record = pose.record().summary();
  line.summary(DiagnosticStatus::OK, "received");
  if (silent(record)) line.summary(DiagnosticStatus::ERROR, "no " + name + " on " + pose.source());
  if (refusedLately(record)) line.mergeSummary(DiagnosticStatus::ERROR, "refused: " + record.last_error);
  const std::string standstill = pose.standstill();
  if (!standstill.empty()) line.summary(DiagnosticStatus::ERROR, standstill);
  if (pose.publishers().value_or(1) > 1) {
    line.mergeSummary(DiagnosticStatus::WARN, "several publishers: the tool jumps between their poses");
  }
  line.add("source", pose.source());
  addRecord(name, record, line);
}

void reportOutput(const OutputWatch& watch, std::uint32_t subscribers, const std::string& node,
                  const std::string& without, DiagnosticsLine& line) {
  line.summary(DiagnosticStatus::OK, "only " + node + " publishes on " + watch.topic());
  if (subscribers == 0) line.summary(DiagnosticStatus::WARN, "no subscriber to " + watch.topic() + ": " + without);
  for (const std::string& other : watch.otherPublishers()) {
    line.mergeSummary(DiagnosticStatus::ERROR, other + " publishes on " + watch.topic() + ", past the guard");
  }
  line.add("topic", watch.topic());
  line.add("subscribers", subscribers);
}

}  // namespace sweep_guard_ros
