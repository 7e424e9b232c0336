#pragma once

#include <array>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Some clusters of a mesh, and the blocks of vertices that hold their corners: what a detector looks at. A view: the
/// mesh, and for a part of it its SubmeshFinder, must outlive it unchanged.
class Submesh {
 public:
  /// All of it.
  Submesh(const TriangleMesh& mesh_M)  // NOLINT(google-explicit-constructor)
      : mesh_M_(&mesh_M),
        boxes_(mesh_M.blocks().arrays()),
        blocks_(&mesh_M.order().blocks),
        clusters_(&mesh_M.order().clusters),
        groups_(&mesh_M.order().groups) {}

  const TriangleMesh& mesh_M() const { return *mesh_M_; }
  bool empty() const { return clusters_->empty(); }

  /// Numbers of the blocks in mesh_M().blocks().
  const std::vector<std::uint32_t>& blocks() const { return *blocks_; }
  /// Their boxes, in this order, padded to simd::kPadding [m].
  const simd::BoxArrays<const float>& boxes() const { return boxes_; }
  /// Ascending. Their `blocks` are indices into blocks().
  const std::vector<Cluster>& clusters() const { return *clusters_; }
  /// Of all clusters of a whole mesh. A part of one has got none.
  const std::vector<ClusterGroup>* groups() const { return groups_; }

  /// Calls a function with the index of each triangle.
  template <typename Function>
  void forEachTriangle(const Function& function) const {
    const std::vector<std::uint32_t>& triangle_at = mesh_M_->order().triangle_at;
    for (const Cluster& cluster : *clusters_) {
      for (std::uint32_t place = cluster.first; place < cluster.first + cluster.count; ++place) {
        function(triangle_at.empty() ? place : triangle_at[place]);
      }
    }
  }

 private:
  friend class SubmeshFinder;

  const TriangleMesh* mesh_M_;
  simd::BoxArrays<const float> boxes_;
  const std::vector<std::uint32_t>* blocks_;
  const std::vector<Cluster>* clusters_;
  const std::vector<ClusterGroup>* groups_;
};

/// Which planes the blocks of a part lie beyond. Keeps its buffers between calls.
class BlockBits {
 public:
  explicit BlockBits(const simd::Kernels& kernels = simd::kernels()) : kernels_(&kernels) {}

  /// What follows is about this part and these planes.
  void classify(const Submesh& part, const simd::Planes& planes);

  /// Calls a function with each cluster of the part but those that lie wholly beyond one of the planes, by the boxes of
  /// their blocks.
  template <typename Function>
  void forEachLeft(const Submesh& part, const Function& function) const {
    const auto consider = [&](size_t first, size_t count) {
      for (size_t i = first; i < first + count; ++i) {
        const Cluster& cluster = part.clusters()[i];
        if (!beyondOnePlane(bits_, cluster.blocks)) function(cluster);
      }
    };
    if (part.groups() == nullptr) return consider(0, part.clusters().size());
    for (const ClusterGroup& group : *part.groups()) {
      if (!beyondOnePlane(group_bits_, group.block_groups)) consider(group.first, group.count);
    }
  }

  /// Whether it is asked for the first time about this block of the part.
  bool firstAsked(std::uint32_t block);

 private:
  using Indices = std::array<std::uint32_t, simd::kClusterBlocks>;

  static bool beyondOnePlane(const std::vector<std::uint16_t>& bits, const Indices& at) {
    const auto& [a, b, c, d] = at;
    return (bits[a] & bits[b] & bits[c] & bits[d] & (simd::kInsideAll - 1)) != 0;
  }

  void classifyGroups(size_t blocks);

  const simd::Kernels* kernels_;
  std::vector<std::uint16_t> bits_;        // of each block, and a flag
  std::vector<std::uint16_t> group_bits_;  // what those of a group have in common
};

/// Finds the part of a mesh that may reach into a convex region. Keeps its buffers between calls.
class SubmeshFinder {
 public:
  /// What is left out lies beyond one of the planes. One pass over the boxes of the blocks.
  /// @param part  not the result of the call before
  /// @returns a view of buffers of this: valid until the next call
  Submesh find(const Submesh& part, const simd::Planes& planes);

 private:
  void keep(const Submesh& part, Cluster cluster);
  void gatherBoxes(Submesh& found);

  BlockBits bits_;
  std::vector<std::uint32_t> new_index_;  // per block of the part, among those kept
  std::vector<std::uint32_t> old_index_;  // and back
  std::vector<std::uint32_t> blocks_;
  std::vector<Cluster> clusters_;
  std::vector<float> sides_;
};

/// A mesh wholly beyond one of the planes, by the box around it.
bool whollyBeyond(const TriangleMesh& mesh_M, const simd::Planes& planes);

}  // namespace sweep_guard_core
