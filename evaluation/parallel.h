#pragma once

#include <cstddef>
#include <functional>

namespace sweep_guard_evaluation {

/// Returns the number of cores, at least 1.
size_t coreCount();

/// Calls task(0) to task(count - 1) on one thread per core, and returns when all have finished.
/// @throws what a task throws; if several throw, one of the exceptions
void inParallel(size_t count, const std::function<void(size_t)>& task);

}  // namespace sweep_guard_evaluation
