#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {

/// A polyhedron that stands for a convex piece of the tool where volumes are computed, along the axes of T and relative
/// to center_T(). A cylinder is a prism of as many sides as mesh_T() and of the same cross-section, a box is itself,
/// and a hull that of the corners of mesh_T(). Padding moves their faces out, so edges stay sharp. Other padded bodies,
/// a sphere or a capsule, are hulls of their farthest points in 114 directions, with the padding enlarged so that a
/// sphere keeps its volume.
class PiecePolytope {
 public:
  explicit PiecePolytope(const ConvexShape& shape_T);

  double volume() const { return volume_; }  ///< [m^3]; 0: the piece is flat, and there are no half-spaces
  const Eigen::Vector3d& center_T() const { return center_T_; }
  const std::vector<HalfSpace>& halfSpaces() const { return half_spaces_; }
  const std::vector<Polygon>& faces() const { return faces_; }  ///< see polytopeFaces()
  const Eigen::Vector3d& axis() const { return axis_; }         ///< along the longest side, away from the tip

  /// Returns the support function for a unit direction [m].
  double support(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d center_T_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
  std::vector<HalfSpace> half_spaces_;
  std::vector<Polygon> faces_;
  double volume_ = 0.0;
};

}  // namespace sweep_guard_core
