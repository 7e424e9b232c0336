#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "peers/peer.h"
#include "scenes.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_benchmark {

/// A workpiece that deforms: an ellipsoid of 0.60 x 0.60 x 0.44 m about the origin, open at two small caps about its
/// poles, with waves of 5 % that run over it.
class Hull {
 public:
  /// @param rings  4 * rings * rings triangles
  explicit Hull(size_t rings) : rings_(rings) {}

  /// At a phase of the waves [rad].
  Surface surface(double phase) const;

  /// A drill of 20 x 150 mm, 30 degrees from the surface's normal, somewhere at the surface, which moves in any
  /// direction and turns about its tip.
  /// @param phase   of the waves [rad]
  /// @param depth   of the tip inside of the surface at the start [m]; negative: outside
  /// @param length  of the step [m]
  /// @param angle   of the turn [rad]
  sweep_guard_core::Motion drilling(sweep_guard_core::Random& random, double phase, double depth, double length,
                                    double angle) const;

 private:
  Eigen::Vector3d point(double polar, double azimuth, double phase) const;

  size_t rings_;
};

/// The drill of Hull::drilling().
sweep_guard_core::ConvexShape drill();

/// Vertices and triangles in another order.
struct Order {
  std::vector<std::uint32_t> vertices;   ///< where each vertex comes from
  std::vector<std::uint32_t> triangles;  ///< where each triangle comes from
};

/// A random one, for every size of mesh another.
Order randomOrder(const Surface& surface);

/// The same surface in that order.
Surface reordered(const Surface& surface, const Order& order);

}  // namespace sweep_guard_benchmark
