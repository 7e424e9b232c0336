#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <variant>
#include <vector>

#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// First and second order statistics of a set of points [P, Sec. 3.1].
struct Moments {
  Eigen::Vector3d mean;        ///< [m]
  Eigen::Matrix3d covariance;  ///< about the mean [m^2], positive semi-definite
};

/// A convex body, fixed in the tool frame T: a round cylinder, a sphere, a box, or the convex hull of points; grown by
/// a padding, as if a ball rolled over it. Everything asked of it is exact for the body itself, not for the mesh that
/// stands for it in pictures and statistics. Points and segments are bodies, too: hulls of one or two points.
class ConvexShape {
 public:
  /// A round cylinder around the z axis of T that fills z in [-length, 0] [P, Sec. 3.1].
  /// @param radius  [m], finite, >= 0
  /// @param length  [m], finite, >= 0; not both 0
  /// @param sides   of the polygonal cylinder of mesh_T(), 3 to 1000
  /// @throws InvalidInput if one is out of range
  static ConvexShape cylinder(double radius, double length, int sides = 32);

  /// A ball around the origin of T.
  /// @param radius  [m], finite, > 0
  /// @throws InvalidInput if it is out of range
  static ConvexShape sphere(double radius);

  /// A box around the origin of T, its edges along the axes.
  /// @param half_extents  [m], finite, >= 0; not all 0
  /// @throws InvalidInput if one is out of range
  static ConvexShape box(const Eigen::Vector3d& half_extents);

  /// The convex hull of points of any number and position.
  /// @param points_T  [m], at least one, finite and within kMaxCoordinate
  /// @throws InvalidInput if there is none, or with the index of the first that is not usable
  static ConvexShape hull(const std::vector<Eigen::Vector3d>& points_T);

  /// The same body elsewhere: what was in T is taken to X_NT.
  ConvexShape placed(const Eigen::Isometry3d& X_NT) const;

  /// The body grown on all sides.
  /// @param distance  [m], >= 0; adds to the padding it has
  ConvexShape padded(double distance) const;

  /// How far the body reaches along a unit direction [m]: max over its points p of direction · p.
  double support(const Eigen::Vector3d& direction_T) const;

  /// A point of the body that reaches farthest along a direction of any length [m].
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_T) const;

  /// Bound [m] on the distance of any point of the body from the line through the origin of T along a unit axis.
  double radiusAbout(const Eigen::Vector3d& axis_T) const;

  /// Bound [m] on the distance of any point of the body from the origin of T.
  double boundingRadius() const;

  /// Points of the front and rear face farthest along a direction of any length [m]: of a cylinder its two discs; of
  /// other bodies the two faces, across its longest side, of a box around it.
  Eigen::Vector3d frontSupport(const Eigen::Vector3d& direction_T) const;
  Eigen::Vector3d rearSupport(const Eigen::Vector3d& direction_T) const;

  double length() const { return faces_.front - faces_.rear + 2.0 * padding_; }  ///< across both faces [m]
  double radius() const { return faces_.half_sides.minCoeff() + padding_; }      ///< least, of a face [m]
  Eigen::Vector3d axis_T() const { return faces_.R_TF.col(2); }                  ///< from rear to front, unit

  /// A round cylinder around the z axis of a frame C, filling z in [-length, 0].
  struct Cylinder {
    double radius;  ///< [m]
    double length;  ///< [m]
    Eigen::Isometry3d X_TC;
  };
  std::optional<Cylinder> asCylinder() const;  ///< the body without padding, if it is one

  const TriangleMesh& mesh_T() const { return mesh_T_; }   ///< its surface without padding; round ones polygonal
  const Moments& moments_T() const { return moments_T_; }  ///< of the corners of these triangles, as often as used

 private:
  struct Round {
    double radius;  // around z, filling z in [-length, 0]
    double length;
  };
  struct Box {
    Eigen::Vector3d half_extents;
  };
  struct Points {
    std::vector<Eigen::Vector3d> corners;
  };
  using Body = std::variant<Round, Box, Points>;

  // Across the z axis of a frame F; round, or rectangles.
  struct Faces {
    Eigen::Matrix3d R_TF = Eigen::Matrix3d::Identity();
    Eigen::Vector3d p_T = Eigen::Vector3d::Zero();  // origin of F
    Eigen::Vector2d half_sides = Eigen::Vector2d::Zero();
    double front = 0.0;
    double rear = 0.0;
    bool round = false;
  };

  ConvexShape(Body body_S, const std::vector<Eigen::Vector3d>& vertices_S, std::vector<Triangle> triangles);
  Faces faces() const;
  Faces facesOfBox(const Eigen::Matrix3d& axes_T) const;
  Eigen::Vector3d faceSupport(double z, const Eigen::Vector3d& direction_T) const;

  Body body_S_;  // in a frame S of its own
  Eigen::Matrix3d R_TS_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_TS_ = Eigen::Vector3d::Zero();
  double padding_ = 0.0;
  TriangleMesh mesh_T_;
  Moments moments_T_;
  Faces faces_;
};

/// How far the body at a pose reaches along a unit direction of the pose's parent frame [m].
double support(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction_M);

/// How far the body reaches in a motion's two poses, before and after the motion's mesh_translation [m]: the support function of
/// the convex hull of all four.
double support(const ConvexShape& shape, const Motion& motion, const Eigen::Vector3d& direction_M);

}  // namespace sweep_guard_core
