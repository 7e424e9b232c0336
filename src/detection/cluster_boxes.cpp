#include "detection/cluster_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr double kDistanceError = 0x1p-20;  // a dozen roundings of 2^-24: point, differences, squares, sums

}  // namespace

void ClusterBoxes::around(const Submesh& submesh) {
  const std::vector<Cluster>& clusters = submesh.clusters();
  origin_M_ = submesh.mesh_M().origin();
  radius_ = submesh.mesh_M().radius();
  count_ = simd::padded(clusters.size());
  sides_.resize(std::max(sides_.size(), 6 * count_));
  for (size_t axis = 0; axis < 3; ++axis) {
    const float* const lower = submesh.boxes().lower[axis];
    const float* const upper = submesh.boxes().upper[axis];
    for (size_t i = 0; i < count_; ++i) {
      const auto& [a, b, c, d] = clusters[std::min(i, clusters.size() - 1)].blocks;
      sides_[axis * count_ + i] = std::min(std::min(lower[a], lower[b]), std::min(lower[c], lower[d]));
      sides_[(3 + axis) * count_ + i] = std::max(std::max(upper[a], upper[b]), std::max(upper[c], upper[d]));
    }
  }
}

double ClusterBoxes::distanceFrom(const Eigen::Vector3d& p_M) const {
  if (count_ == 0) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d p = p_M - origin_M_;
  const auto side = [&](size_t i) { return sides_.data() + i * count_; };
  const simd::BoxArrays<const float> boxes{{side(0), side(1), side(2)}, {side(3), side(4), side(5)}};
  const Eigen::Vector3f rounded = p.cast<float>();
  const double squared = kernels_->nearestBox(boxes, count_, {rounded.x(), rounded.y(), rounded.z()});
  const double doubt = kDistanceError * (radius_ + p.norm()) + 0x1p-48 * origin_M_.norm();
  return std::max(0.0, std::sqrt(squared) - doubt);
}

}  // namespace sweep_guard_core
