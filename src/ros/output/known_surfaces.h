#pragma once

#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Says whether what is computed from the workpieces at a swept pose is complete. Keeps its buffer between calls.
class KnownSurfaces {
 public:
  explicit KnownSurfaces(const sweep_guard_core::WarningMonitor& monitor) : monitor_(monitor) {}

  /// Returns whether there is a workpiece, each was tested at the pose with all its updates, and the warning has no reason
  /// of kSurfacesMissing.
  /// @param report    of the sweep to the pose; the monitor must have it already
  /// @param unplaced  workpieces that were left out
  bool complete(const sweep_guard_core::SweepReport& report, const sweep_guard_core::Workpieces& unplaced);

 private:
  const sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::Warning warning_;
};

}  // namespace sweep_guard_ros
