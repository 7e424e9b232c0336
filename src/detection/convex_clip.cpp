#include "sweep_guard/detection/convex_clip.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard {

void CutTriangle::cut(const Eigen::Vector3d& normal, double offset) {
  assert(count_ > 0 && count_ < corners_.size());
  std::array<Eigen::Vector3d, 3 + kMostHalfSpaces> whole;
  std::copy_n(corners_.begin(), count_, whole.begin());
  const Eigen::Vector3d* before = &whole[count_ - 1];
  double before_out = normal.dot(*before) - offset;
  size_t left = 0;
  for (size_t i = 0; i < count_; ++i) {
    const Eigen::Vector3d& corner = whole[i];
    const double out = normal.dot(corner) - offset;
    if ((out > 0.0) != (before_out > 0.0)) {
      corners_[left++] = *before + before_out / (before_out - out) * (corner - *before);
    }
    if (!(out > 0.0)) corners_[left++] = corner;
    before = &corner;
    before_out = out;
  }
  count_ = left;
}

ConvexClip::ConvexClip(const SweptVolume& volume) {
  volume.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    normals_.row(count_) = normal_B.array();
    offsets_[count_++] = offset;
  });
}

bool ConvexClip::meets(const std::array<Eigen::Vector3d, 3>& corners_B) const {
  std::array<unsigned, 3> beyond{};  // one bit for each plane
  for (size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = corners_B[k];
    for (Eigen::Index i = 0; i < count_; ++i) {
      const double out = normals_(i, 0) * p.x() + normals_(i, 1) * p.y() + normals_(i, 2) * p.z() - offsets_[i];
      beyond[k] |= static_cast<unsigned>(out > 0.0) << i;
    }
    if (beyond[k] == 0) return true;
  }
  if ((beyond[0] & beyond[1] & beyond[2]) != 0) return false;

  CutTriangle left(corners_B);
  const unsigned separating = beyond[0] | beyond[1] | beyond[2];
  for (Eigen::Index i = 0; i < count_ && !left.empty(); ++i) {
    if ((separating >> i & 1U) != 0) left.cut(normals_.row(i).matrix(), offsets_[i]);
  }
  return !left.empty();
}

}  // namespace sweep_guard
