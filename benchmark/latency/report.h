#pragma once

#include "latency/measurement.h"

namespace sweep_guard_benchmark {

/// Prints the figures as a table, and which of the requirements they meet.
void print(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows);

/// Appends the figures to the files of the settings.
/// @throws sweep_guard_core::InvalidInput if a file cannot be written
void save(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows);

}  // namespace sweep_guard_benchmark
