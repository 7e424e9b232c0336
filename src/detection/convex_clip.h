#pragma once

#include <Eigen/Core>
#include <array>

#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// Clips a triangle by planes, one after the other, in double precision [Sutherland and Hodgman 1974]. Allocates
/// nothing.
class ClippedTriangle {
 public:
  explicit ClippedTriangle(const std::array<Eigen::Vector3d, 3>& corners)
      : corners_{corners[0], corners[1], corners[2]} {}

  /// Keeps what lies within n·p <= d, boundary included. Callable kMaxHalfSpaces times, and only while not empty.
  void cut(const Eigen::Vector3d& normal, double offset);
  bool empty() const { return count_ == 0; }

 private:
  static constexpr size_t kMaxCorners = 3 + kMaxHalfSpaces;  // each plane adds one at most
  using Corners = std::array<Eigen::Vector3d, kMaxCorners>;

  Corners corners_;
  size_t count_ = 3;
};

/// Tests whether triangles meet a convex volume.
class ConvexClip {
 public:
  explicit ConvexClip(const SweptVolume& volume);

  /// @param corners_B  in the frame B of the volume's box [m]
  bool meets(const std::array<Eigen::Vector3d, 3>& corners_B) const;

 private:
  struct Corner {
    Eigen::Array<double, kMaxHalfSpaces, 1> out;  // distance beyond each plane [m]
    unsigned beyond = 0;                          // one bit for each plane
  };

  Corner corner(const Eigen::Vector3d& p_B) const;
  static bool meetsEdge(const Corner& a, const Corner& b);  // [Cyrus and Beck 1978]

  // A structure of arrays: each corner is tested against all planes.
  Eigen::Array<double, kMaxHalfSpaces, 3> normals_;
  Eigen::Array<double, kMaxHalfSpaces, 1> offsets_;
  Eigen::Index count_ = 0;
};

}  // namespace sweep_guard_core
