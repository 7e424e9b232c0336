#pragma once

#include <Eigen/Geometry>
#include <array>
#include <variant>
#include <vector>

#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Linear functions f(p) = gradient · p + constant of a point, of which the largest is found on the processor's vector
/// units: of the corners of a hull the support function, of its faces the signed distance.
class LinearFunctions {
 public:
  void add(const Eigen::Vector3d& gradient, double constant);
  bool empty() const { return size_ == 0; }

  /// Returns the index, in the order of add(), of a function that is largest at `p`, up to rounding. There must be one
  /// (asserted).
  size_t largest(const Eigen::Vector3d& p) const;

  Eigen::Vector3d gradient(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  double value(size_t i, const Eigen::Vector3d& p) const { return gradient(i).dot(p) + constant_[i]; }

 private:
  size_t size_ = 0;
  std::vector<double> x_;  // filled up with copies of the last one
  std::vector<double> y_;
  std::vector<double> z_;
  std::vector<double> constant_;
};

/// Mean and covariance of a set of points, each of equal weight [P, Sec. 3.1].
struct Moments {
  Eigen::Vector3d mean;        ///< [m]
  Eigen::Matrix3d covariance;  ///< about the mean [m^2], positive semi-definite
};

/// A convex body, fixed in the tool frame T: a round cylinder, a sphere, a box, or the convex hull of points, grown by
/// a padding (the Minkowski sum with a ball). The support functions are exact, not those of mesh_T(); moments and the
/// axes of hulls and spheres come from mesh_T(). A point and a segment are bodies, too: hulls of one or two points.
class ConvexShape {
 public:
  /// Makes a round cylinder around the z axis of T, with z in [-length, 0] [P, Sec. 3.1].
  /// @param radius  [m], 0 to kMaxCoordinate
  /// @param length  [m], 0 to kMaxCoordinate; not both 0
  /// @param sides   number of sides of mesh_T(), 3 to 1000
  /// @throws InvalidInput if an argument is out of range
  static ConvexShape cylinder(double radius, double length, int sides = 32);

  /// Makes a ball around the origin of T.
  /// @param radius  [m], > 0, at most kMaxCoordinate
  /// @throws InvalidInput if the radius is out of range
  static ConvexShape sphere(double radius);

  /// Makes a box around the origin of T with edges along the axes.
  /// @param half_extents  [m], 0 to kMaxCoordinate; not all 0
  /// @throws InvalidInput if a half extent is out of range
  static ConvexShape box(const Eigen::Vector3d& half_extents);

  /// Makes the convex hull of points, padded by its hull_tolerance (convex_hull.h).
  /// @param points_T  [m], at least one, finite and within kMaxCoordinate
  /// @throws InvalidInput if there is no point, or with the index of the first unusable point
  /// @throws DeviceError if /dev/null cannot be opened
  static ConvexShape hull(const std::vector<Eigen::Vector3d>& points_T);

  /// Returns the body with its frame T placed at X_NT, a rigid transform: N becomes the tool frame of the result.
  /// @throws InvalidInput if a vertex of mesh_T() would lie beyond kMaxCoordinate
  ConvexShape placed(const Eigen::Isometry3d& X_NT) const;

  /// Returns the body grown on all sides.
  /// @param distance  additional padding [m], >= 0 (asserted)
  ConvexShape padded(double distance) const;

  /// Returns the support function for a unit direction [m]: max over points p of the body of direction · p.
  double support(const Eigen::Vector3d& direction_T) const;

  /// Returns a point of the body, in T, that lies farthest along a direction of any length > 0 [m].
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_T) const;

  /// Returns a point of the body without its padding, in T, that lies farthest along a direction of any length > 0 [m].
  Eigen::Vector3d coreSupportPoint(const Eigen::Vector3d& direction_T) const;
  double padding() const { return padding_; }  ///< [m], >= 0

  /// Proposes a minimum translation direction from a triangle that the body without its padding overlaps: unit. Of a
  /// cylinder it is the best one across its axis, of other bodies the normal of the face nearest to the triangle's middle.
  Eigen::Vector3d proposeNormal(const std::array<Eigen::Vector3d, 3>& corners_T) const;

  /// Where a point lies in the body.
  struct Depth {
    double depth;                ///< distance from the surface [m]; negative: not known to be inside
    Eigen::Vector3d outwards_T;  ///< unit normal of the surface at its point nearest to this one
  };
  /// Returns the depth of a point. It is exact, but that of a point outside of a hull of three or more corners without
  /// its padding is -infinity, and so is any depth in such a hull that is flat or has needles as faces.
  Depth depthOf(const Eigen::Vector3d& p_T) const;

  /// Returns an upper bound [m] on the distance of any point of the body from the line through the origin of T along a
  /// unit axis.
  double radiusAbout(const Eigen::Vector3d& axis_T) const;

  /// Returns an upper bound [m] on the distance of any point of the body from the origin of T.
  double boundingRadius() const { return bounding_radius_ + padding_; }

  /// Returns the point of the front or rear face, in T, that lies farthest along a direction of any length [m]. The
  /// faces of a cylinder are its discs; those of other bodies are faces of a box around it, across its longest side.
  /// The front face is the one at the larger coordinate along axis_T(). The faces are those of the body without padding
  /// (of a sphere, its center); padding moves the point by as much along the direction.
  Eigen::Vector3d frontSupport(const Eigen::Vector3d& direction_T) const;
  Eigen::Vector3d rearSupport(const Eigen::Vector3d& direction_T) const;  ///< see frontSupport()

  double length() const { return faces_.front - faces_.rear + 2.0 * padding_; }  ///< between the faces, padded [m]
  double radius() const {
    return faces_.half_sides.minCoeff() + padding_;
  }                                                              ///< smaller half side of a face, padded [m]
  Eigen::Vector3d axis_T() const { return faces_.R_TF.col(2); }  ///< from rear to front, unit
  /// Returns the axes of a box around the body, as columns: of a cylinder and of a box their own. The last is axis_T().
  const Eigen::Matrix3d& axes_T() const { return faces_.R_TF; }

  /// A round cylinder around the z axis of the body frame S, with z in [-length, 0].
  struct Cylinder {
    double radius;  ///< [m]
    double length;  ///< [m]
  };
  /// Returns the body without padding if it is a cylinder, else null.
  const Cylinder* asCylinder() const { return std::get_if<Cylinder>(&body_S_); }

  /// Half extents of a box around the origin of S, with edges along its axes [m].
  using Box = Eigen::Vector3d;
  /// Returns the body without padding if it is a box, else null.
  const Box* asBox() const { return std::get_if<Box>(&body_S_); }

  /// Returns whether the body without padding is a point.
  bool isBall() const {
    return std::holds_alternative<Points>(body_S_) && std::get<Points>(body_S_).corners.size() == 1;
  }

  Eigen::Isometry3d X_TS() const;  ///< pose of the frame of a cylinder or a box

  /// Returns the surface as made, without what padded() added. That of a round body is a polyhedron inside it.
  const TriangleMesh& mesh_T() const { return mesh_T_; }
  const Moments& moments_T() const { return moments_T_; }  ///< of the corners of all triangles of mesh_T()

 private:
  struct Points {
    explicit Points(const std::vector<Eigen::Vector3d>& points);
    std::vector<Eigen::Vector3d> corners;
    LinearFunctions reach;  // of each corner along a direction
    LinearFunctions faces;  // distance outside of each; none if it is not known how deep a point lies
  };
  using Body = std::variant<Cylinder, Box, Points>;

  // Front and rear face, across the z axis of a frame F: discs or rectangles.
  struct Faces {
    Eigen::Matrix3d R_TF = Eigen::Matrix3d::Identity();
    Eigen::Vector3d p_T = Eigen::Vector3d::Zero();  // origin of F
    Eigen::Vector2d half_sides = Eigen::Vector2d::Zero();
    double front = 0.0;
    double rear = 0.0;
    bool round = false;
  };

  ConvexShape(Body body_S, const std::vector<Eigen::Vector3d>& vertices_S, std::vector<Triangle> triangles);
  double boundingRadiusOfBody() const;
  Faces faces() const;
  Faces facesOfBox(const Eigen::Matrix3d& axes_T) const;
  Eigen::Vector3d faceSupport(double z, const Eigen::Vector3d& direction_T) const;

  Body body_S_;
  Eigen::Matrix3d R_TS_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_TS_ = Eigen::Vector3d::Zero();
  double padding_ = 0.0;
  TriangleMesh mesh_T_;
  Moments moments_T_;
  Faces faces_;
  double bounding_radius_;  // without padding
};

/// Returns the support function [m] of the body at a pose, in M, for a unit direction.
double support(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction_M);

/// Returns the support function [m] of the convex hull of the body at both poses of a motion, each before and after a
/// shift by the motion's mesh_translation, in M, for a unit direction.
double support(const ConvexShape& shape, const Motion& motion, const Eigen::Vector3d& direction_M);

}  // namespace sweep_guard_core
