#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// A triangle near one convex piece of the tool, and the certificate of their separation(). In the fixed frame W.
struct NearTriangle {
  size_t piece;                                 ///< index into Tool::pieces()
  std::array<Eigen::Vector3d, 3> corners_W;     ///< [m]
  std::array<Eigen::Vector3d, 3> velocities_W;  ///< of the corners [m/s]
  Eigen::Vector3d normal_W;                     ///< unit, from the triangle to the tool
  double gap;  ///< of the piece before the triangle's farthest corner along normal_W [m]; negative in contact
};

/// Planes that stand for near triangles.
struct PlaneCover {
  std::vector<SeparatingPlane> planes;  ///< nearest triangle first
  std::vector<size_t> triangles;        ///< of each plane: index of the triangle that it was made for
  UncoveredSurfaces uncovered;          ///< what no plane stands for
};

/// Returns few planes behind which the triangles lie. Takes the nearest triangle first; a triangle that lies wholly behind
/// a plane of its piece needs none of its own. A plane may move to the tool by a twentieth of its gap, so that one stands
/// for a surface that is nearly flat.
/// @param beyond      all other surfaces: how near they may be, and how fast
/// @param max_planes  triangles that are left over after so many count as uncovered
PlaneCover coverByPlanes(const std::vector<NearTriangle>& triangles, const UncoveredSurfaces& beyond,
                         size_t max_planes = 64);

}  // namespace sweep_guard_core
