#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace sweep_guard_core {

/// By how much depths are wrong, and differ within a surface [m]. NaN: not seen, joined to nothing.
struct DepthTolerance {
  std::array<float, 2> margin;  ///< the error at a depth z is margin[0] + margin[1] z^2 [m], [1/m]
  float slope;                  ///< largest difference between neighbors, by depth

  float errorAt(float depth) const { return margin[0] + margin[1] * depth * depth; }
  float stepAt(float depth) const { return slope * depth + 2.0F * errorAt(depth); }  ///< a larger difference is a step
  bool joined(float a, float b) const { return std::abs(a - b) <= stepAt(std::min(a, b)); }
};

}  // namespace sweep_guard_core
