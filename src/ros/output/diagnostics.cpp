#include "ros/output/diagnostics.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <utility>

#include "common/number_text.h"
#include "ros/output/workpiece_report.h"
#include "ros/parameters/parameter_changes.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard_core::InputRecord;
using sweep_guard_core::quantile;
using sweep_guard_core::SweepStatistics;
using sweep_guard_core::toSeconds;

constexpr double kMaxClockDifference = 1.0;  // [s]

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  long total = 0;
  long resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

void reportClocks(const sweep_guard_core::Timestamps& pose, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const sweep_guard_core::Instant at = now();
  const double by_stamp = toSeconds(at.stamp - pose.stamp);
  if (by_stamp - toSeconds(at.steady - pose.received) < kMaxClockDifference) return;
  status.mergeSummaryf(DiagnosticStatus::ERROR, "poses are %.0f s old: clocks differ", by_stamp);
}

// Of a transform that counts for this user, until a good one comes. No text is in every message.
void reportRefusal(const Frames& frames, const std::string& user, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::string refusal = frames.refusalFor(user);
  const bool is_told = status.message.find(refusal) != std::string::npos;
  if (!is_told) status.mergeSummary(DiagnosticStatus::ERROR, refusal);
}

}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state,
                         const Inputs& inputs, const ReconfigureServer& reconfigure,
                         const TrajectoryWatch& trajectory_watch)
    : state_(state),
      inputs_(inputs),
      reconfigure_(reconfigure),
      trajectory_watch_(trajectory_watch),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("warning", [this](Status& status) { warning(status); });
  updater_.add("tool pose", [this](Status& status) { pose(status); });
  updater_.add("tool", [this](Status& status) { reportTool(*state_.parameters.get(), status); });
  updater_.add("mesh", [this](Status& status) { mesh(status); });
  updater_.add("mesh vertices", [this](Status& status) { vertices(status); });
  if (inputs.commands() != nullptr) updater_.add("command", [this](Status& status) { command(status); });
  for (const auto& camera : inputs.cameras().all()) {
    updater_.add("camera " + camera->camera().id, [this, &camera = *camera, counts = std::make_shared<Counts>()](
                                                      Status& status) { this->camera(status, camera, *counts); });
  }
  updater_.add("workpieces", [this](Status& status) { workpieces(status); });
  updater_.add("allowed contact", [this](Status& status) { allowed(status); });
  if (!state.parameters.initial().other_tools.empty())
    updater_.add("other tools", [this](Status& status) { otherTools(status); });
  updater_.add("detector", [this](Status& status) { detector(status); });
  updater_.add("prediction", [this](Status& status) { prediction(status); });
  if (!state.parameters.initial().trajectory_action.empty())
    updater_.add("trajectory", [this](Status& status) { trajectory(status); });
  updater_.add("stages", [this](Status& status) { stages(status); });
  updater_.add("parameters", [this](Status& status) { parameters(status); });
  updater_.add("process", [this](Status& status) { process(status); });
}

void Diagnostics::publish() {
  statistics_ = state_.statistics.take();
  updater_.force_update();
}

void Diagnostics::warning(Status& status) const {
  sweep_guard_core::Warning warning;
  state_.monitor.warning(now(), warning);
  const auto disabled_by = state_.monitor.disabledBy();
  const bool unknown = warning.level == sweep_guard_core::WarningLevel::kUnknown;
  status.summary(unknown ? DiagnosticStatus::WARN : DiagnosticStatus::OK, warning.text);
  status.add("level", sweep_guard_core::styleOf(warning.level).name);
  status.add("reasons", warning.reasons);
  status.add("enabled", disabled_by ? "no: disabled by " + *disabled_by : "yes");
  if (warning.covered_until != sweep_guard_core::Time())
    status.addf("covered ahead [s]", "%.3f", toSeconds(warning.covered_until - now().stamp));
}

void Diagnostics::pose(Status& status) {
  input(
      status,
      {inputs_.poses().source(), inputs_.poses().publishers(), inputs_.poses().record().summary(), /*continuous=*/true},
      poses_);
  reportRefusal(state_.frames, "tool", status);
  if (inputs_.poses().publishers().value_or(1) > 1) {
    status.mergeSummary(DiagnosticStatus::WARN, "several publishers: the tool jumps between their poses");
  }
  status.add("lost", inputs_.poses().lost());
  const auto repeated = inputs_.poses().repeated().counts();
  const auto percent = repeatedPercent(std::exchange(repeated_, repeated), repeated);
  if (percent) status.addf("repeated positions [%]", "%.0f", *percent);
  if (const auto newest = inputs_.poses().record().summary().newest) reportClocks(*newest, status);
}

void reportTool(const Parameters& parameters, diagnostic_updater::DiagnosticStatusWrapper& status) {
  size_t of_visuals = 0;
  for (const LinkShape& shape : parameters.link_shapes) {
    of_visuals += shape.is_visual ? 1 : 0;
    status.addf("'" + shape.link + "'", "%zu pieces from its %s geometry", shape.pieces,
                shape.is_visual ? "visual" : "collision");
  }
  for (const std::string& id : parameters.attached) status.add("'" + id + "'", "attached");
  status.summary(DiagnosticStatus::OK,
                 parameters.tool_description +
                     (of_visuals == 0 ? "" : ", " + std::to_string(of_visuals) + " links of visual geometry"));
}

void Diagnostics::mesh(Status& status) {
  const InputRecord::Summary record = inputs_.meshes().meshRecord().summary();
  input(status,
        {inputs_.meshes().meshTopic(), inputs_.meshes().meshPublishers(), record,
         /*continuous=*/record.received == 0},
        meshes_);
}

void Diagnostics::vertices(Status& status) {
  input(status,
        {inputs_.meshes().verticesTopic(), inputs_.meshes().verticesPublishers(),
         inputs_.meshes().verticesRecord().summary(),
         /*continuous=*/false},
        vertices_);
  status.add("dropped", inputs_.meshes().droppedUpdates());
}

void Diagnostics::command(Status& status) {
  const CommandInput& commands = *inputs_.commands();
  input(status, {commands.topic(), commands.publishers(), commands.record().summary(), /*continuous=*/false},
        commands_);
}

void Diagnostics::input(Status& status, const Input& input, Counts& previous) const {
  const InputRecord::Summary& record = input.record;
  const sweep_guard_core::Instant at = now();
  const double rate = static_cast<double>(record.received - previous.received) / toSeconds(at.steady - previous.time);
  const auto silence = input.continuous ? DiagnosticStatus::ERROR : DiagnosticStatus::OK;
  if (rate > 0.0) {
    status.summary(DiagnosticStatus::OK, "received");
  } else if (record.newest) {
    status.summary(silence, input.continuous ? "has stopped" : "nothing new");
  } else if (input.publishers == 0U) {
    status.summary(silence, "no publisher on " + input.source);
  } else {
    status.summary(input.continuous ? DiagnosticStatus::STALE : DiagnosticStatus::OK,
                   "nothing received on " + input.source);
  }
  if (rate == 0.0 && !record.lacking.empty()) status.summary(silence, record.lacking);
  if (record.refused > previous.refused) status.summary(DiagnosticStatus::ERROR, "refused: " + record.last_error);
  const bool warned = !record.last_warning.empty() && record.warning_time > previous.time;
  if (warned) status.mergeSummary(DiagnosticStatus::WARN, record.last_warning);
  previous = {record.received, record.refused, at.steady};

  status.add("source", input.source);
  if (input.publishers) status.add("publishers", *input.publishers);
  status.addf("rate [Hz]", "%.1f", rate);
  if (record.newest) {
    status.addf("age [s]", "%.3f", toSeconds(at.steady - record.newest->received));
    status.addf("age by stamp [s]", "%.3f", toSeconds(at.stamp - record.newest->stamp));
  }
  status.add("received", record.received);
  status.add("refused", record.refused);
  status.add("last error", record.last_error.empty() ? "none" : record.last_error);
  if (!record.last_error.empty()) status.addf("age of the error [s]", "%.1f", toSeconds(at.steady - record.error_time));
}

void Diagnostics::workpieces(Status& status) const {
  reportWorkpieces(state_, inputs_.meshes().passedOver(), status);
  reportRefusal(state_.frames, "workpieces", status);
}

void Diagnostics::camera(Status& status, const CameraInput& camera, Counts& previous) const {
  input(status, {camera.topic(), camera.publishers(), camera.record().summary(), /*continuous=*/true}, previous);
  const auto parameters = state_.parameters.get();
  const auto& links = parameters->robot_links;
  if (const auto shares = camera.shares()) {
    status.addf("pixels with a surface [%]", "%.1f", 100.0 * shares->seen);
    status.addf("pixels of the robot itself [%]", "%.1f", 100.0 * shares->self);
    status.addf("pixels remembered behind it [%]", "%.1f", 100.0 * shares->hidden);
    status.addf("delay until taken [s]", "%.3f", shares->delay);
    status.add("camera", shares->rests ? "rests" : "moves: what the robot hides is not remembered");
    if (shares->tool_found) status.addf("tool where it is expected [%]", "%.0f", 100.0 * *shares->tool_found);
    if (shares->misplaced)
      status.mergeSummary(DiagnosticStatus::ERROR,
                          "the tool is not in the picture where it is expected: is the camera calibrated to the robot, "
                          "its frame in tf right, and self_padding larger than the error?");
    if (shares->unplaced_links > 0)
      status.mergeSummaryf(DiagnosticStatus::WARN, "%zu links of the robot are not in tf: they count as surroundings",
                           shares->unplaced_links);
  }
  status.add("robot", links ? std::to_string(links->size()) + " links left out"
                            : "only the tool is left out: " + parameters->why_no_links);
  status.add("dropped", camera.dropped());
  status.add("detector", "halfspace, whatever `detector` says");
  reportRefusal(state_.frames, frameUserOf(camera.camera().id), status);
}

void Diagnostics::allowed(Status& status) const {
  const auto& pairs = state_.allowed.pairs();
  const std::vector<bool> matched = state_.allowed.matched();
  status.summary(DiagnosticStatus::OK,
                 pairs.empty() ? "none (tool/allowed)" : std::to_string(pairs.size()) + " pairs may touch");
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (!matched[i]) status.mergeSummary(DiagnosticStatus::WARN, "no workpiece '" + pairs[i].mesh_id + "' so far");
    status.add(describe(pairs[i]), matched[i] ? "may touch" : "no such workpiece so far");
  }
}

void Diagnostics::otherTools(Status& status) const {
  const sweep_guard_core::Instant at = now();
  const sweep_guard_core::Duration timeout = state_.parameters.get()->limits.pose_timeout;
  status.summary(DiagnosticStatus::OK, "heard");
  for (const auto& [name, newest, problem] : state_.monitor.otherTools()) {
    const std::string age = newest ? "pose " + sweep_guard_core::inSeconds(sweep_guard_core::age(*newest, at)) + " old"
                                   : std::string("not heard of");
    const bool counts = newest && problem.empty() && !sweep_guard_core::stale(*newest, at, timeout);
    if (!counts) status.mergeSummary(DiagnosticStatus::ERROR, "'" + name + "' does not count");
    status.add("'" + name + "'", problem.empty() ? age : age + ": " + problem);
  }
}

void Diagnostics::detector(Status& status) const {
  reportDetector(statistics_, *state_.parameters.get(), status);
  if (state_.monitor.disabledBy()) status.summary(DiagnosticStatus::WARN, "disabled: nothing is swept");
}

void reportDetector(const SweepStatistics::Summary& statistics, const Parameters& parameters,
                    diagnostic_updater::DiagnosticStatusWrapper& status) {
  const sweep_guard_core::Duration cycle = parameters.guard.cycle;
  const sweep_guard_core::DetectorChoice& detector = parameters.detector;
  status.summary(DiagnosticStatus::OK, detector.name + " keeps up");
  if (statistics.latencies.empty() && statistics.faults == 0) {
    status.summary(DiagnosticStatus::WARN, "no tool pose to sweep to");
  }
  if (!statistics.latencies.empty() && quantile(statistics.latencies, 1.0) > toSeconds(cycle)) {
    status.summary(DiagnosticStatus::WARN, detector.name + " is slower than timing/min_rate: use fewer triangles");
  }
  if (detector.replacesSelect()) {
    status.mergeSummary(DiagnosticStatus::WARN, detector.name + " instead of select: " + detector.missing);
  }
  if (statistics.faults > 0) status.mergeSummary(DiagnosticStatus::ERROR, "failed: " + statistics.last_fault);
  status.add("detector", detector.name);
  if (detector.name == "select") status.add("gl_context", detector.options.gl_context);
  if (!detector.missing.empty()) status.add("missing", detector.missing);
  status.add("volume", sweep_guard_core::nameOf(parameters.guard.sweep.volume));
  status.add("poses swept", statistics.sweeps_total);
  status.addf("deadline [ms]", "%.1f", 1e3 * toSeconds(cycle));
  status.add("cycles missed", statistics.late_total);
  status.addf("pose to warning [ms]", "p50 %.2f, p99 %.2f, max %.2f", 1e3 * quantile(statistics.latencies, 0.5),
              1e3 * quantile(statistics.latencies, 0.99), 1e3 * quantile(statistics.latencies, 1.0));
  status.addf("longest sweep [ms]", "%.2f", 1e3 * statistics.longest_sweep);
  status.add("faults", statistics.faults_total);
  status.add("last error", statistics.last_fault.empty() ? "none" : statistics.last_fault);
}

void Diagnostics::prediction(Status& status) const {
  const auto parameters = state_.parameters.get();
  const std::string& predictor = parameters->guard.predictor.predictor;
  const sweep_guard_core::HorizonOptions& horizon = parameters->guard.horizon;
  const SweepStatistics::PredictionTiming& newest = statistics_.prediction;
  status.summary(DiagnosticStatus::OK, predictor + " predicts");
  if (statistics_.coarser) {
    status.summary(DiagnosticStatus::WARN,
                   "sweeps are longer than horizon/considered_step to keep timing/min_rate: use fewer triangles");
  }
  if (newest.sweeps_made == 0) {
    status.summary(DiagnosticStatus::STALE, "no prediction: two tool poses in a row are needed");
  }
  if (statistics_.prediction_times.empty()) status.summary(DiagnosticStatus::STALE, "no tool pose to predict from");
  if (state_.monitor.disabledBy()) status.summary(DiagnosticStatus::WARN, "disabled: nothing is predicted");
  status.add("predictor", predictor);
  status.add("source", textOf(newest.source));
  status.addf("horizon [s]", "reflex %g, considered %g", toSeconds(horizon.reflex), toSeconds(horizon.considered));
  status.add("predictions", statistics_.predictions_total);
  status.add("deadlines missed", statistics_.late_predictions_total);
  status.addf("sweeps made / asked", "%zu / %zu", newest.sweeps_made, newest.sweeps_asked);
  status.addf("time [ms]", "p50 %.2f, max %.2f", 1e3 * quantile(statistics_.prediction_times, 0.5),
              1e3 * quantile(statistics_.prediction_times, 1.0));
  status.addf("horizon covered [s]", "%.2f", toSeconds(newest.covered));
  status.addf("probability of contact within horizon/considered", "%.3f", newest.probability);
}

void Diagnostics::trajectory(Status& status) const {
  const auto [newest, idle, took] = trajectory_watch_.summary();
  status.summary(newest.clear || idle ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 newest.clear ? "the rest is clear" : newest.text);
  if (!newest.mesh_id.empty())
    status.mergeSummaryf(DiagnosticStatus::WARN, "meets '%s' in %.2f s", newest.mesh_id.c_str(), newest.time.toSec());
  status.add("action", state_.parameters.initial().trajectory_action);
  status.addf("time of the test [ms]", "%.1f", 1e3 * toSeconds(took));
}

void Diagnostics::stages(Status& status) {
  const sweep_guard_core::SteadyTime now = std::chrono::steady_clock::now();
  const sweep_guard_core::StageTimes times = state_.supervisor.stageTimes();
  status.summary(DiagnosticStatus::OK, "share of the time");
  for (size_t i = 0; i < times.size(); ++i) {
    const double share = toSeconds(times[i] - stage_times_[i]) / toSeconds(now - stages_read_);
    status.addf(std::string(sweep_guard_core::kStageNames[i]) + " [%]", "%.3f", 100.0 * share);
  }
  stage_times_ = times;
  stages_read_ = now;
}

void Diagnostics::parameters(Status& status) const {
  const std::vector<ParameterChange> changes = differences(state_.parameters.initial(), *state_.parameters.get());
  const ReconfigureServer::History history = reconfigure_.history();
  status.summary(DiagnosticStatus::OK, changes.empty() ? "unchanged since the start"
                                                       : std::to_string(changes.size()) + " changed since the start");
  for (const ParameterChange& change : changes) {
    status.add(change.key, shown(change.after) + ", at the start " + shown(change.before));
  }
  status.add("last change", history.last_change.empty() ? "none" : history.last_change);
  status.add("last refusal", history.last_refusal.empty() ? "none" : history.last_refusal);
}

void Diagnostics::process(Status& status) const {
  status.summary(DiagnosticStatus::OK, "running");
  status.addf("resident memory [MB]", "%.1f", residentMegabytes());
}

}  // namespace sweep_guard_ros
