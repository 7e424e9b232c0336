#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/detection/submesh.h"

namespace sweep_guard_core {

/// The boxes around the clusters of a submesh. Keeps its buffers from one submesh to the next.
class ClusterBoxes {
 public:
  explicit ClusterBoxes(const simd::Kernels& kernels = simd::kernels()) : kernels_(&kernels) {}

  /// Computes the boxes. The mesh of the submesh must not change before the calls that follow.
  void around(const Submesh& submesh);

  /// Returns a lower bound on the distance of a point from the triangles of the submesh [m]; infinite if it is empty.
  double distanceFrom(const Eigen::Vector3d& p_M) const;

 private:
  const simd::Kernels* kernels_;
  size_t count_ = 0;  // padded with the last box
  std::vector<float> sides_;
  Eigen::Vector3d origin_M_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;  // of the mesh
};

}  // namespace sweep_guard_core
