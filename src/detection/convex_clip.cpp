#include "detection/convex_clip.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {

void ClippedTriangle::cut(const Eigen::Vector3d& normal, double offset) {
  assert(count_ > 0 && count_ < corners_.size());
  Corners whole;
  std::copy_n(corners_.begin(), count_, whole.begin());
  std::array<double, kMaxCorners> out;
  size_t crossings = 0;
  for (size_t i = 0; i < count_; ++i) {
    out[i] = normal.dot(whole[i]) - offset;
    if (i > 0 && (out[i] > 0.0) != (out[i - 1] > 0.0)) ++crossings;
  }
  if ((out[0] > 0.0) != (out[count_ - 1] > 0.0)) ++crossings;
  // A line crosses a convex outline twice. More crossings come from rounding, of corners in the plane.
  if (crossings > 2) return;

  size_t kept = 0;
  for (size_t i = 0; i < count_; ++i) {
    const size_t before = (i + count_ - 1) % count_;
    if ((out[i] > 0.0) != (out[before] > 0.0)) {
      corners_[kept++] = whole[before] + out[before] / (out[before] - out[i]) * (whole[i] - whole[before]);
    }
    if (!(out[i] > 0.0)) corners_[kept++] = whole[i];
  }
  assert(kept <= count_ + 1);
  count_ = kept;
}

ConvexClip::ConvexClip(const SweptVolume& volume) {
  volume.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    normals_.row(count_) = normal_B.array();
    offsets_[count_++] = offset;
  });
}

ConvexClip::Corner ConvexClip::corner(const Eigen::Vector3d& p_B) const {
  Corner corner;
  for (Eigen::Index i = 0; i < count_; ++i) {
    corner.out[i] = normals_(i, 0) * p_B.x() + normals_(i, 1) * p_B.y() + normals_(i, 2) * p_B.z() - offsets_[i];
    corner.beyond |= static_cast<unsigned>(corner.out[i] > 0.0) << i;
  }
  return corner;
}

bool ConvexClip::meetsEdge(const Corner& a, const Corner& b) {
  if ((a.beyond & b.beyond) != 0) return false;
  double enters = 0.0;
  double leaves = 1.0;
  for (unsigned crossed = a.beyond | b.beyond; crossed != 0; crossed &= crossed - 1) {
    const int i = __builtin_ctz(crossed);
    const double crossing = a.out[i] / (a.out[i] - b.out[i]);
    if ((a.beyond >> i & 1U) != 0) {
      enters = std::max(enters, crossing);
    } else {
      leaves = std::min(leaves, crossing);
    }
  }
  return enters <= leaves;
}

bool ConvexClip::meets(const std::array<Eigen::Vector3d, 3>& corners_B) const {
  std::array<Corner, 3> corners;
  for (size_t k = 0; k < 3; ++k) {
    corners[k] = corner(corners_B[k]);
    if (corners[k].beyond == 0) return true;
  }
  const auto& [a, b, c] = corners;
  if ((a.beyond & b.beyond & c.beyond) != 0) return false;
  // Most triangles that meet the volume do so along an edge, and testing edges costs less than clipping.
  if (meetsEdge(a, b) || meetsEdge(b, c) || meetsEdge(c, a)) return true;

  ClippedTriangle remaining(corners_B);
  const unsigned separating = a.beyond | b.beyond | c.beyond;
  for (Eigen::Index i = 0; i < count_ && !remaining.empty(); ++i) {
    if ((separating >> i & 1U) != 0) remaining.cut(normals_.row(i).matrix(), offsets_[i]);
  }
  return !remaining.empty();
}

}  // namespace sweep_guard_core
