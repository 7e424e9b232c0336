#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {

/// Cuts a convex polygon by planes (Sutherland and Hodgman 1974), as clip() does, in buffers of its own.
class PolygonCutter {
 public:
  void begin(const std::array<Eigen::Vector3d, 3>& triangle) {
    corners_.resize(3);
    std::copy(triangle.begin(), triangle.end(), corners_.begin());
  }
  void begin(const Polygon& polygon) { corners_.assign(polygon.begin(), polygon.end()); }

  /// Keeps the part of the polygon that is not beyond a plane, boundary included.
  /// @param beyond  returns the distance of a point beyond the plane, in any unit; linear
  /// @returns whether a part was beyond the plane
  template <typename Distance>
  bool cut(const Distance& beyond);

  const Polygon& corners() const { return corners_; }  ///< three or more, or none

 private:
  Polygon corners_;
  Polygon kept_;
  std::vector<double> out_;  // for each corner: beyond the plane, if positive
};

template <typename Distance>
bool PolygonCutter::cut(const Distance& beyond) {
  const size_t count = corners_.size();
  out_.resize(count);
  bool any = false;
  for (size_t i = 0; i < count; ++i) {
    out_[i] = beyond(corners_[i]);
    any = any || out_[i] > 0.0;
  }
  if (!any) return false;
  kept_.resize(2 * count);
  Eigen::Vector3d* to = kept_.data();
  for (size_t i = 0, before = count - 1; i < count; before = i++) {
    if ((out_[i] > 0.0) != (out_[before] > 0.0)) {
      *to++ = corners_[before] + out_[before] / (out_[before] - out_[i]) * (corners_[i] - corners_[before]);
    }
    if (!(out_[i] > 0.0)) *to++ = corners_[i];
  }
  kept_.resize(static_cast<size_t>(to - kept_.data()));
  corners_.swap(kept_);
  if (corners_.size() < 3) corners_.clear();
  return true;
}

}  // namespace sweep_guard_core
