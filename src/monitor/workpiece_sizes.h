#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "guard/tool_distances.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// What tells an operator whether workpieces and tool are in meters.
struct WorkpieceSizes {
  /// Id, and in words its size and how far the tool is from it and was at least: of the 20 nearest, the nearest first.
  std::vector<std::pair<std::string, std::string>> nearest;
  /// What may be in millimeters, in words: a workpiece longer than 10 m, one that the tool was never nearer to than 5 m. Empty:
  /// nothing
  std::string doubt;
};

/// @param distances  by id; a workpiece may be missing
WorkpieceSizes workpieceSizes(const Workpieces& workpieces,
                              const std::map<std::string, ToolDistances::Distance>& distances);

}  // namespace sweep_guard_core
