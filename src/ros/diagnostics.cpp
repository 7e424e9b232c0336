#include "sweep_guard/ros/diagnostics.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard::toSeconds;

constexpr auto kCycle = std::chrono::milliseconds(66);  // of 15 Hz, the slowest that the paper accepts
constexpr size_t kLatenciesKept = 10000;

double quantile(const std::vector<double>& ascending, double share) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  return ascending[static_cast<size_t>(share * static_cast<double>(ascending.size() - 1))];
}

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  long total = 0;
  long resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace

void Workload::swept(sweep_guard::Duration latency, sweep_guard::Duration sweep_time) {
  const std::lock_guard lock(mutex_);
  ++summary_.sweeps_total;
  if (latency > kCycle) ++summary_.late_total;
  if (summary_.latencies.size() < kLatenciesKept) summary_.latencies.push_back(toSeconds(latency));
  summary_.busiest = std::max(summary_.busiest, toSeconds(sweep_time));
}

void Workload::failed() {
  const std::lock_guard lock(mutex_);
  ++summary_.faults_total;
}

Workload::Summary Workload::take() {
  const std::lock_guard lock(mutex_);
  Summary taken = summary_;
  summary_.latencies.clear();
  summary_.busiest = 0.0;
  std::sort(taken.latencies.begin(), taken.latencies.end());
  return taken;
}

Diagnostics::Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const Parameters& parameters,
                         const PoseInput& poses, const WorkpieceStore& workpieces, const sweep_guard::Ledger& ledger,
                         Workload& workload)
    : parameters_(parameters),
      poses_(poses),
      workpieces_(workpieces),
      ledger_(ledger),
      workload_(workload),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("verdict", [this](Status& status) { verdict(status); });
  updater_.add("tool pose input", [this](Status& status) { poseInput(status); });
  updater_.add("mesh input", [this](Status& status) { meshInput(status); });
  updater_.add("detector and deadlines", [this](Status& status) { deadlines(status); });
  updater_.add("process", [this](Status& status) { process(status); });
}

void Diagnostics::verdict(Status& status) const {
  const sweep_guard::Verdict verdict = ledger_.verdict(now());
  const bool unknown = verdict.level == sweep_guard::Level::kUnknown;
  status.summary(unknown ? DiagnosticStatus::WARN : DiagnosticStatus::OK, verdict.text);
  status.add("reasons", verdict.reasons);
}

void Diagnostics::poseInput(Status& status) {
  const sweep_guard::SteadyTime asked = std::chrono::steady_clock::now();
  const std::uint64_t received = poses_.received();
  const double rate = static_cast<double>(received - poses_before_) / toSeconds(asked - asked_before_);
  poses_before_ = received;
  asked_before_ = asked;
  if (received == 0) {
    status.summary(DiagnosticStatus::STALE, "no tool pose yet on " + poses_.source());
  } else if (rate == 0.0) {
    status.summary(DiagnosticStatus::ERROR, "tool poses have stopped on " + poses_.source());
  } else {
    status.summary(DiagnosticStatus::OK, "tool poses come in");
  }
  status.add("source", poses_.source());
  status.add("publishers", poses_.publisherCount());
  status.addf("rate [Hz]", "%.1f", rate);
  status.add("received", received);
  status.add("refused", poses_.refused());
}

void Diagnostics::meshInput(Status& status) const {
  const sweep_guard::Workpieces workpieces = workpieces_.snapshot();
  const sweep_guard::Instant at = now();
  status.summary(DiagnosticStatus::OK, std::to_string(workpieces.size()) + " workpieces");
  if (workpieces.empty()) status.summary(DiagnosticStatus::STALE, "no workpiece yet");
  for (const auto& workpiece : workpieces) {
    const sweep_guard::Seen seen{workpiece->stamp, workpiece->received};
    if (sweep_guard::stale(seen, at, parameters_.limits.mesh_timeout)) {
      status.mergeSummary(DiagnosticStatus::ERROR, "'" + workpiece->id + "' is stale");
    }
    status.addf("'" + workpiece->id + "'", "revision %u, %zu triangles in '%s', %.3f s old", workpiece->revision,
                workpiece->mesh_M.triangles().size(), workpiece->frame.c_str(), toSeconds(sweep_guard::age(seen, at)));
  }
  status.add("received", workpieces_.received());
  status.add("refused", workpieces_.refused());
}

void Diagnostics::deadlines(Status& status) {
  const Workload::Summary load = workload_.take();
  status.summary(DiagnosticStatus::OK, parameters_.detector + " keeps up");
  if (!load.latencies.empty() && load.latencies.back() > toSeconds(kCycle)) {
    status.summary(DiagnosticStatus::WARN, parameters_.detector + " is slower than 15 Hz: use fewer triangles");
  }
  status.add("detector", parameters_.detector);
  status.add("volume", sweep_guard::nameOf(parameters_.sweep.volume));
  status.add("poses swept", load.sweeps_total);
  status.add("cycles missed", load.late_total);
  status.add("detector faults", load.faults_total);
  status.addf("pose to contacts [ms]", "p50 %.2f, p99 %.2f, max %.2f", 1e3 * quantile(load.latencies, 0.5),
              1e3 * quantile(load.latencies, 0.99), 1e3 * quantile(load.latencies, 1.0));
  status.addf("longest sweep [ms]", "%.2f", 1e3 * load.busiest);
}

void Diagnostics::process(Status& status) const {
  status.summary(DiagnosticStatus::OK, "running");
  status.addf("resident memory [MB]", "%.1f", residentMegabytes());
}

}  // namespace sweep_guard_ros
