#pragma once

#include <sweep_guard/ToolShape.h>
#include <sweep_guard/View.h>

#include <vector>

#include "ros/output/markers.h"

namespace sweep_guard_ros {

/// Converts what the markers show. The caller sets frame and tool.
/// @param scene  must have its tool
sweep_guard::View toMsg(const MarkerScene& scene);
sweep_guard::ToolShape toMsg(
    const std::vector<sweep_guard_core::Tool>& bodies);  ///< converts the tool without its padding

}  // namespace sweep_guard_ros
