#pragma once

#include <string>
#include <vector>

#include "latency/measurement.h"

namespace sweep_guard_benchmark {

/// A figure of a measurement, and the bound that it has to meet.
struct Requirement {
  std::string figure;
  double value;
  std::string bound;  ///< in words, such as "<= 4"
  bool met;
};

/// Returns the requirements on this measurement: every interval is swept; over TCPROS a p99 from pose to warning that
/// depends on the number of triangles; in a nodelet with a million triangles a number of sweeps per second.
/// @param rows  of rowsOf()
std::vector<Requirement> requirementsOn(const Settings& settings, const Measurement& measured,
                                        const std::vector<LatencyRow>& rows);

}  // namespace sweep_guard_benchmark
