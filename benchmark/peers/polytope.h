#pragma once

#include <array>
#include <vector>

namespace sweep_guard_core {
struct Motion;
struct SweptVolume;
}  // namespace sweep_guard_core

namespace sweep_guard_benchmark {

using Point = std::array<double, 3>;

/// A convex volume in the frame M of the mesh, in every form that a peer may want it in.
struct Polytope {
  /// Inside where normal·p <= offset; the normal is unit.
  struct Plane {
    Point normal_M;
    double offset;  ///< [m]
  };

  std::vector<Plane> planes_M;
  std::vector<Point> corners_M;         ///< [m]
  std::vector<std::vector<int>> faces;  ///< indices of corners, counter-clockwise seen from outside
  Point lower_M;                        ///< of the box along the axes of M [m]
  Point upper_M;
  const sweep_guard_core::SweptVolume* swept_M;  ///< the same as the detectors take it
  const sweep_guard_core::Motion* motion_M;      ///< of the tool, which it is made around
};

/// @param swept_M, motion_M  outlive the result
Polytope polytope(const sweep_guard_core::SweptVolume& swept_M, const sweep_guard_core::Motion& motion_M);

/// Whether a triangle meets the polytope, moved out by `grown` [m]: clipped in double precision (Sutherland and Hodgman
/// 1974). Touching is meeting.
bool meets(const Polytope& polytope_M, const float* a_M, const float* b_M, const float* c_M, double grown = 0.0);

}  // namespace sweep_guard_benchmark
