#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <set>
#include <string>

#include "ros/guard/guard_state.h"

namespace sweep_guard_ros {

/// Reports each workpiece: its triangles, age, rule and size, and what is doubtful about it.
/// @param passed_over  ids that came and are none of `mesh_ids`
void reportWorkpieces(const GuardState& state, const std::set<std::string>& passed_over,
                      diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace sweep_guard_ros
