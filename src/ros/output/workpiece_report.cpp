#include "ros/output/workpiece_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "common/number_text.h"
#include "monitor/workpiece_sizes.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard_core::toSeconds;

constexpr double kWorthSaying = 0.001;  // [m]

std::string roundingText(const sweep_guard_core::Workpiece& workpiece) {
  std::array<char, 32> rounding;
  std::snprintf(rounding.data(), rounding.size(), "%.1f mm", 1e3 * workpiece.mesh_M.rounding());
  return "'" + workpiece.id + "' is known to " + rounding.data() +
         " only, for float32 rounds its coordinates: send them in a frame near it";
}

// Each with the rule that holds for it.
void reportAges(const std::vector<std::pair<std::string, sweep_guard_core::Timestamps>>& heard,
                const sweep_guard_core::WarningLimits& limits, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const sweep_guard_core::Instant at = now();
  for (const auto& [id, timestamps] : heard) {
    const sweep_guard_core::Duration timeout = limits.meshTimeout(id);
    if (sweep_guard_core::stale(timestamps, at, timeout))
      status.mergeSummary(DiagnosticStatus::ERROR, "'" + id + "' is stale");
    const std::string rule = timeout == sweep_guard_core::Duration::max()
                                 ? std::string("never stale")
                                 : "stale from " + sweep_guard_core::inSeconds(timeout) + " on";
    status.addf("age of '" + id + "'", "%.3f s, %s", toSeconds(sweep_guard_core::age(timestamps, at)), rule.c_str());
  }
}

// An id with a slash at its front has none in YAML's key.
void reportUnusedRules(const Parameters& parameters, const sweep_guard_core::Workpieces& workpieces,
                       diagnostic_updater::DiagnosticStatusWrapper& status) {
  for (const std::string& id : parameters.ruled_ids) {
    const auto is_ruled = [&](const auto& workpiece) { return workpiece->id == id || workpiece->id == "/" + id; };
    const bool came = std::any_of(workpieces.begin(), workpieces.end(), is_ruled) ||
                      parameters.attached.count(id) + parameters.attached.count("/" + id) > 0;
    if (!came) status.mergeSummary(DiagnosticStatus::WARN, "no workpiece '" + id + "' so far (workpieces)");
  }
}

}  // namespace

void reportWorkpieces(const GuardState& state, const std::set<std::string>& passed_over,
                      diagnostic_updater::DiagnosticStatusWrapper& status) {
  const sweep_guard_core::Workpieces workpieces = state.workpieces.snapshot();
  const auto parameters = state.parameters.get();
  status.summary(DiagnosticStatus::OK, std::to_string(workpieces.size()) + " workpieces");
  if (workpieces.empty()) status.summary(DiagnosticStatus::STALE, "no workpiece yet");
  for (const auto& workpiece : workpieces) {
    status.addf("'" + workpiece->id + "'", "revision %u, %zu triangles in '%s'", workpiece->revision,
                workpiece->mesh_M.triangles().size(), workpiece->frame.c_str());
    if (workpiece->mesh_M.padding() > 0.0)
      status.addf("padding of '" + workpiece->id + "' [m]", "%.6g", workpiece->mesh_M.padding());
    if (workpiece->mesh_M.rounding() >= kWorthSaying)
      status.mergeSummary(DiagnosticStatus::WARN, roundingText(*workpiece));
    if (workpiece->mesh_M.closed() && workpiece->mesh_M.enclosure().partsOverlap())
      status.add(
          "force of '" + workpiece->id + "'",
          "not valid while the tool is in it: closed parts of its surface overlap, and count twice there, or are too "
          "many to tell");
    if (workpiece->mesh_M.openEdges() == 0) continue;
    std::string open;
    sweep_guard_core::appendOpenSurface(workpiece->id, workpiece->mesh_M.openEdges(), open);
    status.add("inside of '" + workpiece->id + "'", open);
  }
  reportAges(state.monitor.heard(), parameters->limits, status);
  reportUnusedRules(*parameters, workpieces, status);
  for (const std::string& id : parameters->attached) status.add("'" + id + "'", "attached to the tool");
  for (const std::string& id : passed_over) status.add("'" + id + "'", "not heard: none of mesh_ids");
  const auto distances = state.distances.get();
  const std::string doubt = sweep_guard_core::doubtfulSizes(workpieces, distances);
  if (!doubt.empty()) status.mergeSummary(DiagnosticStatus::WARN, doubt);
  for (const auto& [id, size] : sweep_guard_core::workpieceSizes(workpieces, distances))
    status.add("size of '" + id + "'", size);
}

}  // namespace sweep_guard_ros
