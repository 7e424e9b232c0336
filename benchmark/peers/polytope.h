#pragma once

#include <array>
#include <vector>

namespace sweep_guard_core {
struct Motion;
struct SweptVolume;
}  // namespace sweep_guard_core

namespace sweep_guard_benchmark {

using Point = std::array<double, 3>;

/// A convex volume in the frame M of the mesh, in every form that a peer needs.
struct Polytope {
  /// The half-space normal·p <= offset; the normal is unit.
  struct Plane {
    Point normal_M;
    double offset;  ///< [m]
  };

  std::vector<Plane> planes_M;
  std::vector<Point> corners_M;         ///< [m]
  std::vector<std::vector<int>> faces;  ///< indices of corners, counter-clockwise seen from outside
  Point lower_M;                        ///< of the axis-aligned box in M [m]
  Point upper_M;
  const sweep_guard_core::SweptVolume* swept_M;  ///< the same volume for the detectors
  const sweep_guard_core::Motion* motion_M;      ///< of the tool that sweeps the volume
};

/// @param swept_M, motion_M  must outlive the result
Polytope polytope(const sweep_guard_core::SweptVolume& swept_M, const sweep_guard_core::Motion& motion_M);

/// Clips a triangle in double precision (Sutherland and Hodgman 1974) and returns whether it meets the polytope whose
/// planes are moved out by `grown` [m]. Touching counts as meeting.
bool meets(const Polytope& polytope_M, const float* a_M, const float* b_M, const float* c_M, double grown = 0.0);

}  // namespace sweep_guard_benchmark
