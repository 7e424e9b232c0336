#pragma once

#include <optional>

#include "sweep_guard/prediction/horizon.h"

namespace sweep_guard_core {

/// How many predicted sweeps fit into a cycle. Predicting must not slow the guard below its rate [P, Sec. 3.2]: as they
/// become dear, the considered interval is swept in fewer, longer ones. The reflex interval keeps its steps. What costs
/// is a volume tested: a sweep takes one or, where it turns far or might meet, several.
class TimeBudget {
 public:
  /// @param cycle  time there is for one pose: its measured sweep and all predicted ones, > 0
  TimeBudget(const HorizonOptions& horizon, Duration cycle);

  /// Number of sweeps to cut the considered interval into now, 1 to consideredSweeps() of the horizon. Before the first
  /// prediction a volume is taken to cost a few measured sweeps.
  /// @param reflex_volumes      that the reflex interval takes at the least
  /// @param considered_volumes  that the considered interval takes at the least if it is swept step by step
  size_t consideredSweeps(size_t reflex_volumes, size_t considered_volumes) const;

  /// Time there is for predicting now; not below 0.
  Duration forPrediction() const;

  /// What the newest measured sweep took.
  void spentOnMeasured(Duration time);

  /// What the newest prediction took, with so many volumes tested on a workpiece; 0: there was none.
  void spentOnPredicted(Duration time, size_t volumes);

 private:
  HorizonOptions horizon_;
  Duration cycle_;
  double measured_ = 0.0;             // [s], slow to fall
  std::optional<double> per_volume_;  // [s], slow to fall
};

}  // namespace sweep_guard_core
