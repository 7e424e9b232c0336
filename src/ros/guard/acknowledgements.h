#pragma once

#include <string>

#include "guard/cross_check.h"
#include "guard/workpiece_store.h"
#include "ros/parameters/live_parameters.h"
#include "ros/process/log_throttle.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Acknowledges warnings of workpieces that the tool is near, and ends acknowledgements of those that the tool has left. For
/// the guard's thread only.
class Acknowledgements {
 public:
  /// All must outlive this.
  Acknowledgements(const LiveParameters& parameters, sweep_guard_core::WarningMonitor& monitor,
                   sweep_guard_core::QuerySampler& sampler, sweep_guard_core::Guard& guard)
      : parameters_(parameters), monitor_(monitor), sampler_(sampler), guard_(guard) {}

  /// Acknowledges a warning, see WarningMonitor.
  /// @param id      of the workpiece; empty: the one that the warning names
  /// @param origin  of the queries: the newest pose in the guard
  /// @returns the id
  /// @throws sweep_guard_core::Error if there is nothing to acknowledge, or the tool is farther away than
  ///     warning/acknowledge_distance
  std::string add(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
                  const sweep_guard_core::QueryOrigin& origin);

  /// Ends acknowledgements of workpieces that the tool is not near, or not known to be near. Returns whether there was one.
  bool endWhereFar(const sweep_guard_core::Workpieces& workpieces, const sweep_guard_core::QueryOrigin& origin);

 private:
  std::string warnedOf() const;
  bool isKnownNear(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
                   const sweep_guard_core::QueryOrigin& origin);
  bool isNear(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
              const sweep_guard_core::QueryOrigin& origin);

  const LiveParameters& parameters_;
  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::QuerySampler& sampler_;
  sweep_guard_core::Guard& guard_;
  LogThrottle log_;
};

}  // namespace sweep_guard_ros
