#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/motion_predictor.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/prediction/horizon.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Options of Guard.
struct GuardOptions {
  SweepOptions sweep;
  PredictorOptions predictor;
  HorizonOptions horizon;
  /// Contacts at more standard deviations off the predicted path are not looked for, which saves time: their probability
  /// is 0. From 0, where only contacts of the path itself are found, to 3.09; not checked. See deviationsAt().
  double max_deviations = 3.09;
  /// Contact of these pairs is reported apart (SweepResult::allowed), is not predicted, and keeps nothing from being clear.
  AllowedPairs allowed = {};
  Duration cycle = fromSeconds(1.0 / 15.0);  ///< a prediction may take 75 % of it less the time of one sweep, > 0
  /// Clock that measures what sweeps cost; must not be empty or go back (not checked). Called in the guard's thread.
  std::function<SteadyTime()> clock = std::chrono::steady_clock::now;
};

/// Holds the changes to a running guard. `options` replaces all options of the guard, except the clock; another member
/// that is empty or null changes nothing.
struct GuardChange {
  GuardOptions options;                          ///< start from the current ones: defaults replace them, too
  std::vector<Tool> bodies = {};                 ///< of the tool, as many as the guard has
  std::shared_ptr<const Robot> robot = nullptr;  ///< whose tools `bodies` are, with the joints that the guard's has
  std::unique_ptr<Detector> detector = nullptr;
  /// Made from `options.predictor`, for the same bodies; empty: the guard keeps its predictor and what it has learned, and
  /// `options.predictor` has no effect.
  std::optional<MotionPredictor> predictor = {};
};

}  // namespace sweep_guard_core
