#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "guard/body_boxes.h"
#include "guard/body_prediction.h"
#include "guard/measured_sweeps.h"
#include "guard/united_bodies.h"

namespace sweep_guard_core {

/// One rigid body of the guarded tool, and what Guard keeps for it.
struct GuardedBody {
  /// @param points  that stand for it, see BodyBoxes
  GuardedBody(Tool tool_B, const GuardOptions& options, size_t points)
      : tool(std::move(tool_B)), boxes(tool, points), running(std::make_unique<BodyPrediction>(options)) {}

  Tool tool;  ///< in the frame of the body
  BodyBoxes boxes;
  MeasuredSweeps sweeps;
  IntendedTouches touches;
  std::unique_ptr<BodyPrediction> running;
  // Of a body but the first, until they are united with those of the first:
  SweepReport report;
  Prediction prediction;
};

/// Adds the results of all bodies to that of the first.
/// @param own  where each of the others has its own
template <typename Result>
void uniteResults(const std::vector<std::unique_ptr<GuardedBody>>& bodies, Result GuardedBody::*own, Result& all) {
  size_t first_piece = bodies[0]->tool.pieces().size();
  for (size_t i = 1; i < bodies.size(); ++i) {
    unite(all, (*bodies[i]).*own, first_piece);
    first_piece += bodies[i]->tool.pieces().size();
  }
}

}  // namespace sweep_guard_core
