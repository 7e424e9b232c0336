#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard {

/// Leaves out the triangles that lie wholly beyond one plane of a volume: they cannot meet it. One pass over the
/// vertices, one over the triangles. Keeps its buffers between calls.
class Cull {
 public:
  /// Triangles that are left, ascending. Valid until the next call.
  const std::vector<std::uint32_t>& operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M);

  /// The same, of these triangles alone: only their corners are looked at.
  /// @param among  indices of triangles: ascending, each once; not the result of the call before
  const std::vector<std::uint32_t>& operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                               const std::vector<std::uint32_t>& among);

 private:
  std::vector<std::uint16_t> beyond_;  // per vertex: one bit for each plane that it lies beyond
  std::vector<std::uint32_t> left_;
};

}  // namespace sweep_guard
