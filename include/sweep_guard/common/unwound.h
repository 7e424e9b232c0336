#pragma once

#include <cmath>

namespace sweep_guard_core {

/// Returns the angle, plus as many full turns as bring it nearest to another one [rad].
inline double unwound(double angle, double near) {
  constexpr double kFullTurn = 2.0 * 3.14159265358979323846;
  return near + std::remainder(angle - near, kFullTurn);
}

}  // namespace sweep_guard_core
