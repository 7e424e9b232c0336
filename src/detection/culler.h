#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// A triangle that does not lie beyond any single plane of a volume.
struct RemainingTriangle {
  std::uint32_t triangle;
  bool met;  ///< a corner is certainly inside the volume; false: in doubt
};

/// Decides in float32 what is certain: leaves out triangles that lie wholly beyond one plane of a convex volume, and
/// marks triangles with a corner inside. Tests the boxes of groups of clusters first, then those of clusters, then the
/// corners of triangles. In motion, a corner is beyond a plane if it is at both ends of its way, and inside if it is at one.
/// Keeps its buffers between calls.
class Culler {
 public:
  explicit Culler(const simd::Kernels& kernels = simd::kernels()) : kernels_(&kernels), bits_(kernels) {}

  /// Returns the remaining triangles, in no particular order. Valid until the next call.
  /// @param planes  planes of the volume, from floatPlanes()
  const std::vector<RemainingTriangle>& cull(const Submesh& submesh, const simd::Planes& planes);

  /// Returns whether a triangle remains.
  bool leavesAny(const Submesh& submesh, const simd::Planes& planes);

 private:
  void findClusters(const Submesh& submesh, const simd::Planes& planes);
  void classifyBlock(const Submesh& submesh, const simd::Planes& planes, std::uint32_t block);
  simd::TriangleBits classified(const MeshOrder& order, const Cluster& cluster) const;
  void cullCluster(const TriangleMesh& mesh_M, const Cluster& cluster);

  const simd::Kernels* kernels_;
  BlockBits bits_;
  std::vector<const Cluster*> clusters_;    // that remain
  std::vector<std::uint32_t> blocks_;       // of the remaining clusters, each once
  std::vector<std::uint16_t> vertex_bits_;  // of each block of the submesh; valid for those of remaining clusters only
  std::vector<RemainingTriangle> remaining_;
};

}  // namespace sweep_guard_core
