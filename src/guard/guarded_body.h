#pragma once

#include "guard/intended_touches.h"
#include "guard/measured_sweeps.h"
#include "guard/path_checker.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// One rigid body of the guarded tool, and what Guard keeps for it.
struct GuardedBody {
  GuardedBody(Tool tool_B, const PathChecker::Options& options) : tool(std::move(tool_B)), checker(options) {}

  Tool tool;  ///< in the frame of the body
  MeasuredSweeps sweeps;
  IntendedTouches touches;
  PathChecker checker;
  // Of a body but the first, until they are united with those of the first:
  SweepReport report;
  Prediction prediction;
};

}  // namespace sweep_guard_core
