#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Keeps how near a tool comes to a workpiece along a predicted path: the least deviations (PredictedSweep) by the time
/// when the sweeps begin. A sweep that comes no nearer than one that begins earlier changes no probability.
class ClosestApproach {
 public:
  void clear() { falls_.clear(); }
  void add(Duration from, double deviations);
  /// Returns the least deviations of the sweeps that begin at `from` or earlier; infinite if there are none.
  double upTo(Duration from) const;

 private:
  std::vector<std::pair<Duration, double>> falls_;  // ascending in time, falling in deviations
};

/// Keeps the closest approaches to several workpieces, for all bodies of a tool. Keeps its buffers.
class ClosestApproaches {
 public:
  void clear() { used_ = 0; }
  /// Returns the approach to a workpiece; the reference stays valid until clear().
  ClosestApproach& to(const Workpiece& workpiece);

 private:
  std::deque<std::pair<const Workpiece*, ClosestApproach>> approaches_;  // more than `used_` are buffers to use again
  size_t used_ = 0;
};

}  // namespace sweep_guard_core
