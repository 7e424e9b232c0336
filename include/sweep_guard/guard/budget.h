#pragma once

#include <optional>

#include "sweep_guard/prediction/horizon.h"

namespace sweep_guard {

/// How many predicted sweeps fit into a cycle. Predicting must not slow the guard below its rate [P, Sec. 3.2]: as the
/// sweeps cost more, the considered interval is cut into fewer, longer ones. The reflex interval keeps its steps.
class Budget {
 public:
  /// @param cycle  time there is for one pose: its measured sweep and all predicted ones, > 0
  Budget(const HorizonOptions& horizon, Duration cycle);

  /// Number of sweeps to cut the considered interval into now, at least 1. Before the first prediction a sweep of it is
  /// taken to cost a few measured ones.
  /// @param reflex_sweeps  how many the reflex interval takes
  size_t consideredSweeps(size_t reflex_sweeps) const;

  /// What the newest measured sweep took.
  void spentOnMeasured(Duration time);

  /// What the newest prediction took, with so many sweeps; 0: there was none.
  void spentOnPredicted(Duration time, size_t sweeps);

 private:
  HorizonOptions horizon_;
  Duration cycle_;
  double measured_ = 0.0;            // [s], slow to fall
  std::optional<double> per_sweep_;  // [s], slow to fall
};

}  // namespace sweep_guard
