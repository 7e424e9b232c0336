#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard {

/// First and second order statistics of a set of points [P, Sec. 3.1].
struct Moments {
  Eigen::Vector3d mean;        ///< [m]
  Eigen::Matrix3d covariance;  ///< about the mean [m^2], positive semi-definite
};

/// The rigid tool, in its frame T: origin at the tip, z pointing out of the tip. It is the cylinder of [P, Sec. 3.1],
/// filling z in [-length, 0]. Every extent is that of the round cylinder; the polygonal one serves its statistics.
class Tool {
 public:
  /// @param radius  [m], finite, >= 0
  /// @param length  [m], finite, >= 0; not both 0
  /// @param sides   of the polygonal cylinder, 3 to 1000
  /// @throws InvalidInput if one is out of range
  static Tool cylinder(double radius, double length, int sides = 32);

  double radius() const { return radius_; }               ///< [m]
  double length() const { return length_; }               ///< [m]
  const TriangleMesh& mesh_T() const { return mesh_T_; }  ///< the polygonal cylinder, its corners on the round one
  const Moments& moments_T() const {
    return moments_T_;
  }  ///< of the corners of its triangles, each as often as it is used

  /// How far the tool reaches along a unit direction [m]: max over its points p of direction · p. Exact.
  double support(const Eigen::Vector3d& direction_T) const;

  /// Bound [m] on the distance of any tool point from the line through the origin of T along a unit axis.
  double reach(const Eigen::Vector3d& axis_T) const;

  /// Largest distance of a tool point from the origin of T [m].
  double extent() const;

  /// Points of the front face (z = 0) and the rear face (z = -length) farthest along a direction of any length [m].
  Eigen::Vector3d frontExtreme(const Eigen::Vector3d& direction_T) const;
  Eigen::Vector3d rearExtreme(const Eigen::Vector3d& direction_T) const;

 private:
  Tool(double radius, double length, TriangleMesh mesh_T);

  double radius_;
  double length_;
  TriangleMesh mesh_T_;
  Moments moments_T_;
};

/// How far the tool at a pose reaches along a unit direction of the pose's parent frame [m].
double support(const Tool& tool, const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction_M);

/// How far the tool reaches at either end of the motion [m]: the support function of the convex hull of both.
double support(const Tool& tool, const Motion& motion, const Eigen::Vector3d& direction_M);

}  // namespace sweep_guard
