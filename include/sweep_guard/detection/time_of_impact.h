#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {

/// A triangle in mesh frame M [m] that moves while the tool does: each corner goes straight at constant speed. Where
/// the mesh rests, end and start are equal.
struct MovingTriangle {
  std::array<Eigen::Vector3d, 3> start_M;
  std::array<Eigen::Vector3d, 3> end_M;
};

/// The first contact of the tool with a triangle.
struct Impact {
  double time_of_impact;     ///< fraction of the motion, in [0, 1]
  Eigen::Vector3d point_M;   ///< on the triangle, at the time of impact [m]
  Eigen::Vector3d normal_M;  ///< unit, from the triangle to the tool: of the closest points at the time of impact
  double depth;              ///< how far the tool must go back along the normal to be free at the end [m], >= 0
};

/// When a convex part of the tool first comes as close as `margin` to a triangle. Empty if it is *proven* that it does
/// not, at any time; the time of impact is never later than the true one.
///
/// Conservative advancement: a direction n that separates the two at a time, from separation(), is carried on in time.
/// G(s) = min over the tool of n · q(s) - max over the triangle of n · p(s) is evaluated exactly by the support
/// mapping. A corner's n · p(s) is linear in s. A tool point turns by w s about an axis k through the origin of T, at
/// no more than rho = reach(k) from it, while that origin goes straight: |n · q''| <= K = w^2 rho |n x k|. Linear
/// interpolation between 0 and s errs by at most K/2 x (s - x), for each point and so for the least of all:
///
///     G(x) >= (1 - x/s) G(0) + x/s G(s) - K/2 x (s - x)    for x in [0, s]
///
/// Where the least of the right side exceeds the margin, nothing happens before s. A secant finds such an s, there the
/// next direction is looked for; so it goes on until the gap is the margin, or the end is reached.
///
/// It ends within a tolerance above the margin: 2e-9 of the size of tool and triangle, and 1e-14 of how far they are
/// apart at the start and the end, and from the origin of M, where the poses have been rounded [m]. So the time of
/// impact is early by that, over the speed of closing. Should 1000 directions not suffice, the time that was reached
/// counts as the time of impact.
///
/// If the tool overlaps the triangle at the start already, the time of impact is 0 and the normal is `contact_normal_M` where
/// that is given, or else the direction of least depth.
/// @param parts     of one motion, of equal duration, end to end, as split() gives them; not empty. Each one's `deviation_bound`
/// is
///                  added to the margin
///                  A motion's `mesh_translation` is not looked at: the triangle has its own
/// @param margin    [m], >= 0. Not part of the depth
/// @param contact_normal_M  unit: the normal along which the tool came in earlier
std::optional<Impact> timeOfImpact(const ConvexShape& shape_T, const std::vector<Motion>& parts,
                                   const MovingTriangle& triangle, double margin,
                                   const std::optional<Eigen::Vector3d>& contact_normal_M = std::nullopt);

}  // namespace sweep_guard_core
