#pragma once

#include <limits>

namespace sweep_guard_core {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kDistanceRounding =
    1e-9;  // relative, of the distances between a piece of the tool and a triangle

}  // namespace sweep_guard_core
