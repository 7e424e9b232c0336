#pragma once

#include <string>

namespace sweep_guard_benchmark {

/// Returns a few lines: the processor, the instruction set that the detectors use, the compiler and its flags.
std::string machineText();

/// Returns the load of the machine, averaged over the last minute.
double load();

}  // namespace sweep_guard_benchmark
