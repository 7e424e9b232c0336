#pragma once

#include "latency/measurement.h"

namespace sweep_guard_benchmark {

/// Prints figures as a table, and whether what is promised is kept.
void print(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows);

/// Appends them to the files that the settings name.
/// @throws sweep_guard_core::InvalidInput if one cannot be written
void save(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows);

}  // namespace sweep_guard_benchmark
