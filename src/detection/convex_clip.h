#pragma once

#include <Eigen/Core>
#include <array>

#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// What is left of a triangle when it is cut by planes, one after the other [Sutherland and Hodgman 1974]. In double
/// precision, without a buffer.
class ClippedTriangle {
 public:
  explicit ClippedTriangle(const std::array<Eigen::Vector3d, 3>& corners)
      : corners_{corners[0], corners[1], corners[2]}, count_(3) {}

  /// Keeps what lies within n·p <= d: its boundary, too. At most kMaxHalfSpaces times; not of nothing.
  void cut(const Eigen::Vector3d& normal, double offset);
  bool empty() const { return count_ == 0; }

 private:
  static constexpr size_t kMaxCorners = 3 + kMaxHalfSpaces;  // each plane adds one at most
  using Corners = std::array<Eigen::Vector3d, kMaxCorners>;

  Corners corners_;
  size_t count_;
};

/// Tells whether triangles meet a convex volume.
class ConvexClip {
 public:
  explicit ConvexClip(const SweptVolume& volume);

  /// @param corners_B  in the frame of the volume's box [m]
  bool meets(const std::array<Eigen::Vector3d, 3>& corners_B) const;

 private:
  struct Corner {
    Eigen::Array<double, kMaxHalfSpaces, 1> out;  // beyond each plane [m]
    unsigned beyond = 0;                          // one bit for each plane
  };

  Corner corner(const Eigen::Vector3d& p_B) const;
  static bool meetsEdge(const Corner& a, const Corner& b);  // [Cyrus and Beck 1978]

  // Structure of arrays: all planes are looked at for each corner.
  Eigen::Array<double, kMaxHalfSpaces, 3> normals_;
  Eigen::Array<double, kMaxHalfSpaces, 1> offsets_;
  Eigen::Index count_ = 0;
};

}  // namespace sweep_guard_core
