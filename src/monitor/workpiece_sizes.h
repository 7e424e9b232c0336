#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "guard/tool_distances.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

// What tells an operator whether workpieces and tool are in meters.

/// Returns of each workpiece its id, and in words its size and how far the tool is from it and was at least: of the 20
/// nearest, the nearest first.
/// @param distances  by id; a workpiece may be missing
std::vector<std::pair<std::string, std::string>> workpieceSizes(
    const Workpieces& workpieces, const std::map<std::string, ToolDistances::Distance>& distances);

/// Returns what may be in millimeters, in words: a workpiece longer than 10 m, one that the tool was never nearer to than
/// 5 m. Empty: nothing.
std::string doubtfulSizes(const Workpieces& workpieces,
                          const std::map<std::string, ToolDistances::Distance>& distances);

}  // namespace sweep_guard_core
