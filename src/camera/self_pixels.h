#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/vertex_blocks.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Finds the vertices that the robot itself has: what lies in the volumes around its bodies. Keeps its buffers.
class SelfPixels {
 public:
  /// Finds the vertices within any of the volumes. Tests the boxes of tiles first.
  /// @param places_F   of the vertices of a grid: x0 y0 z0 x1 ... [m]
  /// @param bodies_F   convex volumes around the bodies, as much larger as what is near to them counts as the robot
  void find(const std::vector<float>& places_F, const std::vector<SweptVolume>& bodies_F);

  /// Returns for each tile of the grid a bit for each of its pixels.
  const std::vector<std::uint32_t>& tiles() const { return tiles_; }

 private:
  void add(const std::vector<float>& places_F, const simd::Planes& planes);

  VertexBlocks blocks_;
  std::vector<std::uint16_t> beyond_;  // of each tile, planes
  std::vector<std::uint32_t> tiles_;
};

}  // namespace sweep_guard_core
