#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Three vertex indices, 0-based, of either winding.
using Triangle = std::array<std::uint32_t, 3>;

/// Consecutive triangles, whose corners lie in few blocks of vertices.
struct Cluster {
  std::uint32_t number;  ///< among all of the mesh
  std::uint32_t first;   ///< place of the first triangle
  std::uint32_t count;   ///< 1 to simd::kCluster
  /// Those of its corners; if there are fewer, the last one again.
  std::array<std::uint32_t, simd::kClusterBlocks> blocks;
};

/// Blocks that are looked at together: consecutive ones, from a multiple of this on.
constexpr std::uint32_t kBlocksTogether = 8;
constexpr std::uint32_t kClustersTogether = 8;  ///< at most

/// Consecutive clusters, whose blocks lie in few groups of kBlocksTogether.
struct ClusterGroup {
  std::uint32_t first;  ///< number of the first cluster
  std::uint32_t count;  ///< 1 to kClustersTogether
  /// Groups of blocks; if there are fewer, the last one again.
  std::array<std::uint32_t, simd::kClusterBlocks> block_groups;
};

/// The order in which the vertices and triangles of a mesh are kept, so that what lies close together in space does in
/// memory. Depends on the first deformation seen; any other is served as well, as long as neighbours stay neighbours.
/// The sender's own order is kept where it is good enough, and most are.
struct MeshOrder {
  std::vector<std::uint32_t> vertex_places;   ///< place of each of the sender's vertices; empty: as they came
  std::vector<std::uint32_t> triangle_at;     ///< the sender's triangle at each place; empty: as they came
  std::vector<Cluster> clusters;              ///< of all places, ascending
  std::vector<simd::ClusterCorners> corners;  ///< of each cluster
  std::vector<ClusterGroup> groups;           ///< of all clusters, ascending
  std::vector<std::uint32_t> blocks;          ///< 0, 1, ... of the vertices
};

/// @param positions  x0 y0 z0 x1 ... [m], as sent
/// @param triangles  as sent; each index is one of a vertex
MeshOrder orderOf(const std::vector<float>& positions, const std::vector<Triangle>& triangles);

/// Puts positions, as sent, in their places.
/// @param places  of MeshOrder: not empty
/// @param[out] kept  of the same size
void place(const std::vector<std::uint32_t>& places, const std::vector<float>& sent, std::vector<float>& kept);

}  // namespace sweep_guard_core
