#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "peers/peer.h"
#include "scenes.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_benchmark {

/// A workpiece that deforms: an ellipsoid of 0.60 x 0.60 x 0.44 m around the origin, with small openings at its poles
/// and waves of 5 % that run over it.
class Hull {
 public:
  /// @param rings  4 * rings * rings triangles
  explicit Hull(size_t rings) : rings_(rings) {}

  /// Returns the surface at a phase of the waves [rad].
  Surface surface(double phase) const;

  /// Returns a motion of the drill at a random place of the surface: the drill is tilted by 30 degrees against the
  /// normal, moves in a random direction and turns about its tip.
  /// @param phase   of the waves [rad]
  /// @param depth   of the tip inside the surface at the start [m]; negative: outside
  /// @param length  of the step [m]
  /// @param angle   of the turn [rad]
  sweep_guard_core::Motion drilling(sweep_guard_core::Random& random, double phase, double depth, double length,
                                    double angle) const;

 private:
  Eigen::Vector3d point(double polar, double azimuth, double phase) const;

  size_t rings_;
};

/// Returns the drill of Hull::drilling(): 20 x 150 mm.
sweep_guard_core::ConvexShape drill();

/// An order of vertices and triangles: the old index at each new place.
struct Order {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> triangles;
};

/// Returns a random order, which depends on the number of triangles alone.
Order randomOrder(const Surface& surface);

/// Returns the same surface in another order.
Surface reordered(const Surface& surface, const Order& order);

}  // namespace sweep_guard_benchmark
