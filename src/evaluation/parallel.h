#pragma once

#include <cstddef>
#include <functional>

namespace sweep_guard_evaluation {

/// Calls task(0) to task(count - 1) on as many threads as the machine has cores, and returns when all are done.
/// @throws what a task throws; of several one
void inParallel(size_t count, const std::function<void(size_t)>& task);

}  // namespace sweep_guard_evaluation
