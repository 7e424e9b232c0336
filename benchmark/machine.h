#pragma once

#include <string>

namespace sweep_guard_benchmark {

/// Processor, instructions that it has and that we use, compiler with its flags: a few lines.
std::string machineText();

/// The machine's load over the last minute.
double load();

}  // namespace sweep_guard_benchmark
