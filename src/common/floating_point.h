#pragma once

#include <limits>

namespace sweep_guard_core {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace sweep_guard_core
