#include "sweep_guard/ros/diagnostics.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard::toSeconds;

constexpr size_t kTimesKept = 10000;

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

void Workload::swept(sweep_guard::Duration latency, sweep_guard::Duration sweep_time, size_t failures) {
  const std::lock_guard lock(mutex_);
  ++summary_.sweeps_total;
  summary_.faults_total += failures;
  if (latency > cycle_) ++summary_.late_total;
  if (summary_.latencies.size() < kTimesKept) summary_.latencies.push_back(toSeconds(latency));
  summary_.busiest = std::max(summary_.busiest, toSeconds(sweep_time));
}

void Workload::predicted(const Prediction& prediction, size_t failures) {
  const std::lock_guard lock(mutex_);
  ++summary_.predictions_total;
  summary_.faults_total += failures;
  if (prediction.latency > cycle_) ++summary_.late_predictions_total;
  if (summary_.prediction_times.size() < kTimesKept) summary_.prediction_times.push_back(toSeconds(prediction.time));
  if (prediction.sweeps_made > 0 && prediction.sweeps_made < prediction.sweeps_asked) summary_.coarser = true;
  summary_.prediction = prediction;
}

Workload::Summary Workload::take() {
  const std::lock_guard lock(mutex_);
  Summary taken = summary_;
  summary_.latencies.clear();
  summary_.busiest = 0.0;
  summary_.prediction_times.clear();
  summary_.coarser = false;
  std::sort(taken.latencies.begin(), taken.latencies.end());
  std::sort(taken.prediction_times.begin(), taken.prediction_times.end());
  return taken;
}

void Workload::restart() {
  const std::lock_guard lock(mutex_);
  summary_ = {};
}

double RateMeter::operator()(std::uint64_t count) {
  const sweep_guard::SteadyTime asked = std::chrono::steady_clock::now();
  const double rate = static_cast<double>(count - count_) / toSeconds(asked - asked_);
  count_ = count;
  asked_ = asked;
  return rate;
}

Diagnostics::Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const Parameters& parameters,
                         const Diagnosed& parts)
    : parameters_(parameters), parts_(parts), updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("verdict", [this](Status& status) { verdict(status); });
  updater_.add("tool pose input", [this](Status& status) { poseInput(status); });
  updater_.add("mesh input", [this](Status& status) { meshInput(status); });
  updater_.add("detector and deadlines", [this](Status& status) { deadlines(status); });
  updater_.add("prediction", [this](Status& status) { prediction(status); });
  updater_.add("process", [this](Status& status) { process(status); });
}

void Diagnostics::publish() {
  load_ = parts_.workload.take();
  updater_.force_update();
}

void Diagnostics::verdict(Status& status) const {
  const sweep_guard::Verdict verdict = parts_.ledger.verdict(now());
  const bool unknown = verdict.level == sweep_guard::Level::kUnknown;
  status.summary(unknown ? DiagnosticStatus::WARN : DiagnosticStatus::OK, verdict.text);
  status.add("reasons", verdict.reasons);
}

void Diagnostics::poseInput(Status& status) {
  const PoseInput& poses = parts_.poses;
  const double rate = poses_rate_(poses.received());
  const double refused = refused_poses_rate_(poses.refused());
  status.summary(DiagnosticStatus::OK, "tool poses come in");
  if (refused > 0.0) status.summary(DiagnosticStatus::ERROR, "tool poses are refused: the log says why");
  if (rate == 0.0) status.summary(DiagnosticStatus::ERROR, "tool poses have stopped on " + poses.source());
  if (poses.received() == 0) status.summary(DiagnosticStatus::STALE, "no tool pose yet on " + poses.source());
  const sweep_guard::Time newest = parts_.ledger.verdict(now()).pose_stamp;
  status.add("source", poses.source());
  status.add("publishers", poses.publisherCount());
  status.addf("rate [Hz]", "%.1f", rate);
  if (newest != sweep_guard::Time())
    status.addf("age of the newest swept [s]", "%.3f", toSeconds(now().stamp - newest));
  status.add("received", poses.received());
  status.add("refused", poses.refused());
}

void Diagnostics::meshInput(Status& status) {
  const WorkpieceStore& store = parts_.workpieces;
  const sweep_guard::Workpieces workpieces = store.snapshot();
  const sweep_guard::Instant at = now();
  const double rate = meshes_rate_(store.received());
  status.summary(DiagnosticStatus::OK, std::to_string(workpieces.size()) + " workpieces");
  if (workpieces.empty()) status.summary(DiagnosticStatus::STALE, "no workpiece yet");
  if (refused_meshes_rate_(store.refused()) > 0.0) {
    status.mergeSummary(DiagnosticStatus::ERROR, "messages are refused: the log says why");
  }
  status.add("mesh topic", parts_.meshes.meshTopic());
  status.add("mesh publishers", parts_.meshes.meshPublishers());
  status.add("vertices topic", parts_.meshes.verticesTopic());
  status.add("vertices publishers", parts_.meshes.verticesPublishers());
  status.addf("rate [Hz]", "%.1f", rate);
  for (const auto& workpiece : workpieces) {
    const sweep_guard::Seen seen{workpiece->stamp, workpiece->received};
    if (sweep_guard::stale(seen, at, parameters_.limits.mesh_timeout)) {
      status.mergeSummary(DiagnosticStatus::ERROR, "'" + workpiece->id + "' is stale");
    }
    status.addf("'" + workpiece->id + "'", "revision %u, %zu triangles in '%s', %.3f s old", workpiece->revision,
                workpiece->mesh_M.triangles().size(), workpiece->frame.c_str(), toSeconds(sweep_guard::age(seen, at)));
  }
  status.add("received", store.received());
  status.add("refused", store.refused());
}

void Diagnostics::deadlines(Status& status) const {
  status.summary(DiagnosticStatus::OK, parameters_.detector + " keeps up");
  if (!load_.latencies.empty() && load_.latencies.back() > toSeconds(parameters_.guard.cycle)) {
    status.summary(DiagnosticStatus::WARN,
                   parameters_.detector + " is slower than timing/min_rate: use fewer triangles");
  }
  status.add("detector", parameters_.detector);
  status.add("gl_context", parameters_.detector_options.gl_context);
  status.add("volume", sweep_guard::nameOf(parameters_.guard.sweep.volume));
  status.add("poses swept", load_.sweeps_total);
  status.add("cycles missed", load_.late_total);
  status.add("detector faults", load_.faults_total);
  status.addf("pose to warning [ms]", "p50 %.2f, p99 %.2f, max %.2f", 1e3 * quantile(load_.latencies, 0.5),
              1e3 * quantile(load_.latencies, 0.99), 1e3 * quantile(load_.latencies, 1.0));
  status.addf("longest sweep [ms]", "%.2f", 1e3 * load_.busiest);
}

void Diagnostics::prediction(Status& status) const {
  const std::string& predictor = parameters_.guard.predictor.predictor;
  status.summary(DiagnosticStatus::OK, predictor + " looks ahead");
  if (load_.coarser) {
    status.summary(DiagnosticStatus::WARN,
                   "the considered interval is swept more coarsely than horizon/considered_step "
                   "to keep timing/min_rate: use fewer triangles");
  }
  status.add("predictor", predictor);
  status.add("predictions", load_.predictions_total);
  status.add("deadlines missed", load_.late_predictions_total);
  const Workload::Prediction& newest = load_.prediction;
  if (load_.prediction_times.empty() || newest.sweeps_made == 0) {
    status.summary(DiagnosticStatus::STALE, "no prediction: two tool poses in a row are needed");
  }
  status.addf("sweeps made / asked", "%zu / %zu", newest.sweeps_made, newest.sweeps_asked);
  status.addf("time [ms]", "p50 %.2f, max %.2f", 1e3 * quantile(load_.prediction_times, 0.5),
              1e3 * quantile(load_.prediction_times, 1.0));
  status.addf("horizon covered [s]", "%.2f", toSeconds(newest.covered));
  status.addf("probability of contact", "%.3f", newest.probability);
}

void Diagnostics::process(Status& status) const {
  status.summary(DiagnosticStatus::OK, "running");
  status.addf("resident memory [MB]", "%.1f", residentMegabytes());
}

}  // namespace sweep_guard_ros
