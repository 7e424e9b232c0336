#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"
#include "sweep_guard/geometry/vertex_blocks.h"

namespace sweep_guard_core {

/// A box along the axes of a frame [m].
struct CenteredBox {
  Eigen::Vector3d center;
  Eigen::Vector3d half;

  explicit CenteredBox(const Eigen::AlignedBox3f& box)
      : center(0.5 * (box.min().cast<double>() + box.max().cast<double>())), half(box.max().cast<double>() - center) {}
};

/// Joins the boxes of a mesh's blocks to those of its clusters and groups of clusters.
class BlockBoxes {
 public:
  /// @param blocks  must outlive the calls that follow
  void assign(const VertexBlocks& blocks);

  Eigen::AlignedBox3f of(const Cluster& cluster) const;
  Eigen::AlignedBox3f of(const ClusterGroup& group) const;
  Eigen::AlignedBox3f of(const MeshOrder& mesh) const;  ///< of all its clusters

 private:
  Eigen::AlignedBox3f block(size_t index) const;

  simd::BoxArrays<const float> boxes_{};
  std::vector<Eigen::AlignedBox3f> together_;  // of kBlocksTogether blocks
};

}  // namespace sweep_guard_core
