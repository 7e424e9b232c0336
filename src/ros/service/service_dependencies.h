#pragma once

#include "guard/workpiece_store.h"
#include "ros/input/frames.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// What services know of the guard.
struct ServiceDependencies {
  const LiveParameters& parameters;
  const Frames& frames;
  sweep_guard_core::WorkpieceStore& workpieces;
  sweep_guard_core::WarningMonitor& monitor;
};

}  // namespace sweep_guard_ros
