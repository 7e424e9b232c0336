#include "ros/black_box/black_box_diagnostics.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

double inMebibytes(std::uintmax_t size) { return static_cast<double>(size) / (1U << 20U); }

}  // namespace

BlackBoxDiagnostics::BlackBoxDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                         const BlackBoxParameters& parameters, const Recorder& recorder,
                                         const ros::Subscriber& warnings)
    : parameters_(parameters),
      recorder_(recorder),
      warnings_(warnings),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("memory", [this](Status& status) { memory(status); });
  updater_.add("recordings", [this](Status& status) { recordings(status); });
}

void BlackBoxDiagnostics::memory(Status& status) const {
  const Recorder::Summary summary = recorder_.summary();
  status.summary(DiagnosticStatus::OK, "listening");
  if (warnings_.getNumPublishers() == 0) {
    status.summary(DiagnosticStatus::WARN, "no guard publishes " + warnings_.getTopic() + ": no contact is noticed");
  }
  if (summary.too_large > 0) {
    status.mergeSummary(DiagnosticStatus::WARN, "messages are larger than half of memory: see the log");
  }
  status.addf("time kept [s]", "%.1f", sweep_guard_core::toSeconds(summary.length));
  status.add("messages", summary.messages);
  status.addf("size [MiB]", "%.1f", inMebibytes(summary.size));
  status.add("messages too large", summary.too_large);
}

void BlackBoxDiagnostics::recordings(Status& status) const {
  const Recorder::Summary summary = recorder_.summary();
  std::uintmax_t size = 0;
  for (const auto& recording : summary.stored) size += recording.size;
  status.summary(DiagnosticStatus::OK, summary.writing ? "a recording is being written" : "ready");
  if (summary.failed > 0) status.summary(DiagnosticStatus::WARN, "a recording could not be written: see the log");
  if (!summary.problem.empty()) status.summary(DiagnosticStatus::ERROR, "nothing can be written: " + summary.problem);
  status.add("folder", parameters_.folder.string());
  status.add("recordings there", summary.stored.size());
  status.addf("size [MiB]", "%.1f", inMebibytes(size));
  status.add("written", summary.written);
  status.add("failed", summary.failed);
  status.add("event that waits", summary.waiting ? nameOf(*summary.waiting) : "none");
  if (!summary.newest.empty()) status.add("newest", summary.newest);
}

}  // namespace sweep_guard_ros
