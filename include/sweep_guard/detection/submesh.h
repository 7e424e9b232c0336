#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// The triangles that a detector tests: some clusters (ranges of triangles) of a mesh, and the blocks (ranges of
/// vertices) that hold their corners; see mesh_order.h. A view of the mesh and of the buffers of the SubmeshFinder that
/// returned it, if one did: they must outlive the view and not change.
class Submesh {
 public:
  /// Views the whole mesh.
  Submesh(const TriangleMesh& mesh_M)  // NOLINT(google-explicit-constructor)
      : Submesh(mesh_M, mesh_M.blocks(), /*in_motion=*/false) {}
  /// Views a grid on the way from where its vertices were before: a triangle is all that it may have passed if its corners went
  /// straight, at any speed.
  static Submesh inMotion(const TriangleMesh& mesh_M) { return {mesh_M, mesh_M.blocksInMotion(), /*in_motion=*/true}; }

  const TriangleMesh& mesh_M() const { return *mesh_M_; }
  bool isInMotion() const { return in_motion_; }  ///< made by inMotion()
  /// Returns the box around the whole mesh, relative to mesh_M().origin() [m].
  const Eigen::AlignedBox3d& bounds() const { return *bounds_; }
  bool empty() const { return clusters_->empty(); }

  /// Returns the blocks, as indices into the boxes of mesh_M().blocks() or, in motion, blocksInMotion().
  const std::vector<std::uint32_t>& blocks() const { return *blocks_; }
  /// Returns the boxes around the vertices of blocks(), in that order, relative to mesh_M().origin() [m]; each array is
  /// padded to a multiple of simd::kPadding with unspecified values.
  const simd::BoxArrays<const float>& boxes() const { return boxes_; }
  /// Returns the clusters, ascending by number. Their `blocks` are indices into blocks(), not into the mesh's blocks.
  const std::vector<Cluster>& clusters() const { return *clusters_; }
  /// Returns the groups of clusters of a whole mesh; null for a submesh from a SubmeshFinder.
  const std::vector<ClusterGroup>* groups() const { return groups_; }

  /// Calls a function with the index in mesh_M().triangles() of each triangle that exists, once, in no particular order.
  template <typename Function>
  void forEachTriangle(const Function& function) const {
    const std::vector<std::uint32_t>& triangle_at = mesh_M_->order().triangle_at;
    for (const Cluster& cluster : *clusters_) {
      for (std::uint64_t left = mesh_M_->existing(cluster); left != 0; left &= left - 1) {
        const std::uint32_t place = cluster.first + static_cast<std::uint32_t>(__builtin_ctzll(left));
        function(triangle_at.empty() ? place : triangle_at[place]);
      }
    }
  }

 private:
  friend class SubmeshFinder;

  Submesh(const TriangleMesh& mesh_M, const VertexBlocks& blocks, bool in_motion)
      : mesh_M_(&mesh_M),
        in_motion_(in_motion),
        bounds_(&blocks.bounds()),
        boxes_(blocks.arrays()),
        blocks_(&mesh_M.order().blocks),
        clusters_(&mesh_M.order().clusters),
        groups_(&mesh_M.order().groups) {}

  const TriangleMesh* mesh_M_;
  bool in_motion_;
  const Eigen::AlignedBox3d* bounds_;
  simd::BoxArrays<const float> boxes_;
  const std::vector<std::uint32_t>* blocks_;
  const std::vector<Cluster>* clusters_;
  const std::vector<ClusterGroup>* groups_;
};

/// Finds the planes that the boxes of a submesh's blocks lie wholly beyond. Keeps its buffers between calls.
class BlockBits {
 public:
  /// @param kernels  must outlive this object
  explicit BlockBits(const simd::Kernels& kernels = simd::kernels()) : kernels_(&kernels) {}

  /// Computes which planes each block of the submesh lies beyond (n·p > d), for the calls that follow.
  /// @param planes  relative to mesh_M().origin()
  void classify(const Submesh& submesh, const simd::Planes& planes);

  /// Calls a function with each cluster of the submesh, except clusters whose blocks all lie beyond the same plane, and those
  /// without a triangle that exists.
  /// @param submesh  the one of the last classify(); not checked
  template <typename Function>
  void forEachRemaining(const Submesh& submesh, const Function& function) const {
    const auto consider = [&](size_t first, size_t count) {
      for (size_t i = first; i < first + count; ++i) {
        const Cluster& cluster = submesh.clusters()[i];
        if (!beyondOnePlane(bits_, cluster.blocks) && submesh.mesh_M().existing(cluster) != 0) function(cluster);
      }
    };
    if (submesh.groups() == nullptr) return consider(0, submesh.clusters().size());
    for (const ClusterGroup& group : *submesh.groups()) {
      if (!beyondOnePlane(group_bits_, group.block_groups)) consider(group.first, group.count);
    }
  }

  /// Returns whether this is the first call for this block since classify().
  /// @param block  index into the submesh's blocks()
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
  std::vector<std::uint16_t> group_bits_;  // bits that all blocks of a group have in common
};

/// Finds the clusters of a mesh whose triangles may reach into a convex region. Keeps its buffers between calls.
class SubmeshFinder {
 public:
  /// Finds the clusters of `around` that may reach inside of all planes: leaves out only clusters that lie beyond one
  /// plane. One pass over the boxes of the blocks.
  /// @param around  not a result of this object (asserted)
  /// @param planes  relative to the origin() of the mesh
  /// @returns a view of this object's buffers: valid until the next call
  Submesh find(const Submesh& around, const simd::Planes& planes);

  /// Finds the clusters of `around` that may reach into a box; otherwise as above.
  /// @param box_M  along the axes of M [m]; may be infinite
  Submesh find(const Submesh& around, const Eigen::AlignedBox3d& box_M);

 private:
  void keep(const Submesh& around, Cluster cluster);
  void gatherBoxes(Submesh& found);

  BlockBits bits_;
  std::vector<std::uint32_t> new_index_;  // of each block of `around`, among those kept
  std::vector<std::uint32_t> old_index_;  // of each block kept, in `around`
  std::vector<std::uint32_t> blocks_;
  std::vector<Cluster> clusters_;
  std::vector<float> sides_;
};

/// Returns whether the box around the mesh lies wholly beyond one of the planes; false in doubt.
/// @param planes  relative to origin() of the mesh
bool whollyBeyond(const Submesh& submesh, const simd::Planes& planes);

/// The boxes around the clusters of a submesh. Keeps its buffers from one submesh to the next.
class ClusterBoxes {
 public:
  /// Computes the boxes. The mesh of the submesh must not change before the calls that follow.
  void around(const Submesh& submesh);

  /// Returns a lower bound on the distance of a point from the triangles of the submesh [m]; infinite if it is empty.
  double distanceFrom(const Eigen::Vector3d& p_M) const;

 private:
  const simd::Kernels* kernels_ = &simd::kernels();
  size_t count_ = 0;  // padded with the last box
  std::vector<float> sides_;
  Eigen::Vector3d origin_M_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;  // of the mesh
};

}  // namespace sweep_guard_core
