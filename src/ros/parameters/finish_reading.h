#pragma once

#include <limits>

#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Reads `diagnostic_period`, which diagnostic_updater uses in every node, and warns of the parameters that were not read.
/// @returns the settings of all parameters that were read
inline ParameterReader::Settings finishReading(ParameterReader& read) {
  read.number("diagnostic_period", 1.0, {0.0, std::numeric_limits<double>::infinity()});
  read.warnOfUnread();
  return read.settings();
}

}  // namespace sweep_guard_ros
