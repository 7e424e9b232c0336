#include "sweep_guard/detection/convex_clip.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard {

void CutTriangle::cut(const Eigen::Vector3d& normal, double offset) {
  assert(count_ > 0 && count_ < corners_.size());
  Corners whole;
  std::copy_n(corners_.begin(), count_, whole.begin());
  std::array<double, kMostCorners> out;
  size_t crossings = 0;
  for (size_t i = 0; i < count_; ++i) {
    out[i] = normal.dot(whole[i]) - offset;
    if (i > 0 && (out[i] > 0.0) != (out[i - 1] > 0.0)) ++crossings;
  }
  if ((out[0] > 0.0) != (out[count_ - 1] > 0.0)) ++crossings;
  // A line crosses a convex outline twice: what is more is rounding, of corners in the plane.
  if (crossings > 2) return;

  size_t left = 0;
  for (size_t i = 0; i < count_; ++i) {
    const size_t before = (i + count_ - 1) % count_;
    if ((out[i] > 0.0) != (out[before] > 0.0)) {
      corners_[left++] = whole[before] + out[before] / (out[before] - out[i]) * (whole[i] - whole[before]);
    }
    if (!(out[i] > 0.0)) corners_[left++] = whole[i];
  }
  assert(left <= count_ + 1);
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
