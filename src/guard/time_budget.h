#pragma once

#include <optional>

#include "sweep_guard/prediction/horizon.h"

namespace sweep_guard_core {

/// Decides how many predicted sweeps fit into a cycle, so that prediction does not slow the guard below its rate
/// [P, Sec. 3.2]. If sweeps take long, the considered interval is cut into fewer, longer ones; the reflex interval keeps
/// its steps. Costs are counted in tested volumes: a sweep takes one, or several if it turns far or might meet a workpiece.
class TimeBudget {
 public:
  /// @param cycle  as GuardOptions::cycle
  TimeBudget(const HorizonOptions& horizon, Duration cycle);

  /// Returns the number of sweeps to cut the considered interval into, from 1 to consideredSweeps() of the horizon.
  /// Until the first prediction a volume is assumed to cost a few measured sweeps.
  /// @param reflex_volumes      least number of volumes in the reflex interval
  /// @param considered_volumes  least number of volumes in the considered interval if every step is swept
  /// @param bodies              each of which is swept as often; counted in the volumes already
  size_t consideredSweeps(size_t reflex_volumes, size_t considered_volumes, size_t bodies = 1) const;

  /// Returns the time for one prediction: 75 % of the cycle less that of one measured sweep, >= 0.
  Duration forPrediction() const;

  /// Records how long the newest measured sweep took.
  void spentOnMeasured(Duration time);

  /// Records how long the newest prediction took.
  /// @param volumes  number of volumes tested on a workpiece; 0: nothing was predicted
  void spentOnPredicted(Duration time, size_t volumes);

 private:
  HorizonOptions horizon_;
  Duration cycle_;
  double measured_ = 0.0;             // [s], falls slowly
  std::optional<double> per_volume_;  // [s], falls slowly
};

}  // namespace sweep_guard_core
