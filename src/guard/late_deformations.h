#pragma once

#include <chrono>

#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Longest time between two deformations for which the motion between them is swept.
constexpr Duration kMaxUpdateInterval = std::chrono::milliseconds(500);

/// Forgets the first deformations of a workpiece, up to the newest but one, while there are more than poses far behind the
/// mesh may need: older ones would widen the test, and take memory, without end.
/// @param deformations  in the order of their stamps; not empty
/// @returns whether one is forgotten
bool forgetLateDeformations(const Workpiece& newest, Workpieces& deformations);

}  // namespace sweep_guard_core
