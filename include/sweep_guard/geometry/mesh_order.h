#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Three vertex indices, 0-based, of either winding.
using Triangle = std::array<std::uint32_t, 3>;

/// Vertices, in any unit, and the triangles between them.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;  ///< indices into `vertices`
};

/// A range of triangles at consecutive places whose corners lie in few blocks. A place is the index of a vertex or
/// triangle in memory (MeshOrder); a block is simd::kBlock vertices at consecutive places.
struct Cluster {
  std::uint32_t number;  ///< index among all clusters of the mesh
  std::uint32_t first;   ///< place of the first triangle
  std::uint32_t count;   ///< 1 to simd::kCluster
  /// The blocks of its corners; unused entries repeat the last block.
  std::array<std::uint32_t, simd::kClusterBlocks> blocks;

  /// Returns a bit for each of its triangles, from the lowest on.
  std::uint64_t all() const { return ~std::uint64_t{0} >> (simd::kCluster - count); }
};

/// Size of a group of consecutive blocks, except the last; the first index of a group is a multiple of it.
constexpr std::uint32_t kBlocksTogether = 8;
constexpr std::uint32_t kClustersTogether = 8;  ///< largest size of a group of consecutive clusters

/// A range of clusters whose blocks lie in few groups of kBlocksTogether blocks.
struct ClusterGroup {
  std::uint32_t first;  ///< index of the first cluster
  std::uint32_t count;  ///< 1 to kClustersTogether

  /// Groups of its blocks: group i begins at block i * kBlocksTogether. Unused entries repeat the last one.
  std::array<std::uint32_t, simd::kClusterBlocks> block_groups;
};

/// Holds the order in memory of the vertices and triangles of a mesh: neighbors in space are near each other there.
/// The sender's order is that of the arguments of orderOf(); it is kept where it is good enough. The order is computed
/// from the first positions. It is correct for every deformation, and fast as long as neighbors stay neighbors.
struct MeshOrder {
  std::vector<std::uint32_t> vertex_places;   ///< place of each of the sender's vertices; empty: the sender's order
  std::vector<std::uint32_t> triangle_at;     ///< the sender's triangle at each place; empty: the sender's order
  std::vector<Cluster> clusters;              ///< cover all places, ascending
  std::vector<simd::ClusterCorners> corners;  ///< of each cluster's triangles
  std::vector<ClusterGroup> groups;           ///< cover all clusters, ascending
  std::vector<std::uint32_t> blocks;          ///< indices 0, 1, ... of all blocks
};

/// Computes the order of a mesh.
/// @param positions  x0 y0 z0 x1 ... [m], finite, at least one vertex; not checked
/// @param triangles  indices below the number of vertices; not checked
/// @throws InvalidInput if the environment variable SWEEP_GUARD_SIMD is wrong (simd::kernels())
MeshOrder orderOf(const std::vector<float>& positions, const std::vector<Triangle>& triangles);

/// Returns the order of triangles whose vertices and triangles stay in the sender's order.
/// @param vertices   their number, > 0
/// @param triangles  as above
MeshOrder sendersOrder(size_t vertices, const std::vector<Triangle>& triangles);

/// Copies positions from the sender's order to their places.
/// @param places     MeshOrder::vertex_places; if it is empty, nothing is copied
/// @param sent       x0 y0 z0 x1 ... of as many vertices as there are places
/// @param[out] kept  positions at their places; another vector, which must have the size of `sent` before the call
void place(const std::vector<std::uint32_t>& places, const std::vector<float>& sent, std::vector<float>& kept);

}  // namespace sweep_guard_core
