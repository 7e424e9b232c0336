#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// A triangle that no plane of a volume separates from it.
struct RemainingTriangle {
  std::uint32_t triangle;
  bool met;  ///< a corner is certainly inside of the volume; else it remains to be seen
};

/// Tells in float32 what is certain: the triangles that lie wholly beyond one plane of a convex volume are left out,
/// and those with a corner inside are met. First groups of clusters and clusters, by the boxes of their blocks; then
/// triangles, by their corners. Keeps its buffers between calls.
class Culler {
 public:
  explicit Culler(const simd::Kernels& kernels = simd::kernels()) : kernels_(&kernels), bits_(kernels) {}

  /// Triangles that are left, ascending. Valid until the next call.
  /// @param planes  of the volume; see floatPlanes()
  const std::vector<RemainingTriangle>& cull(const Submesh& part, const simd::Planes& planes);

 private:
  void findLeft(const Submesh& part, const simd::Planes& planes);
  void look(const MeshOrder& order, const Cluster& cluster);

  const simd::Kernels* kernels_;
  BlockBits bits_;
  std::vector<const Cluster*> clusters_;    // that are left
  std::vector<std::uint32_t> blocks_;       // of these, each once
  std::vector<std::uint16_t> vertex_bits_;  // of each block of the part; those of others mean nothing
  std::vector<RemainingTriangle> remaining_;
};

}  // namespace sweep_guard_core
