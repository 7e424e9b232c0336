#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "interaction/piece_polytope.h"

namespace sweep_guard_core {

/// Integrals over a surface in a polytope and over what lies in the polytope below it, in the frame of FaceColumns.
/// Surfaces that face down count negative for the volume: of a closed surface remains what it encloses.
struct SurfaceSums {
  double volume = 0.0;                                      ///< [m^3]
  Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero();  ///< of the position over the volume [m^4]
  Eigen::Vector3d area = Eigen::Vector3d::Zero();           ///< of the normal over the surface [m^2]
  Eigen::Matrix3d area_moment = Eigen::Matrix3d::Zero();    ///< of position times transposed normal [m^3]
};

/// A convex polytope as columns: each stands on the outline that faces have along a direction, infinitely high. The
/// frame has its origin at PiecePolytope::center_T() and z along the direction. A polygon in a column is cut at each
/// face of it; what is above a face that looks down belongs to the polytope, until a face that looks up.
///
/// The part of a polygon above a face is above that face only, so sums over the faces, with the sign of the side to
/// which they look, are sums over the polygon in the polytope, and over the prisms below it.
class FaceColumns {
 public:
  /// @param up  unit, along the axes of T
  FaceColumns(const PiecePolytope& piece, const Eigen::Vector3d& up);

  const Eigen::Matrix3d& R_CT() const { return R_CT_; }          ///< from the axes of T to those of the columns
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }  ///< of the polytope [m]

  /// Adds the integrals of a convex polygon. Its corners are counter-clockwise seen from the side of its normal.
  /// @param corners  [m], 3 or more
  void add(const Polygon& corners, SurfaceSums& sums);

 private:
  struct Walls {  // of a column, an array for each coefficient: inside is x * p.x + y * p.y <= d
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> d;
    double beyond(size_t i, const Eigen::Vector3d& p) const { return x[i] * p.x() + y[i] * p.y() - d[i]; }
  };
  struct Floor {  // the plane of a face: z = x * p.x + y * p.y + d
    double x;
    double y;
    double d;
    double sign;    // 1: the face looks down, -1: up
    double lowest;  // point of the face
    double highest;
    double below(const Eigen::Vector3d& p) const { return p.z() - (x * p.x() + y * p.y() + d); }  // height of p
  };
  struct Column {
    explicit Column(const std::vector<Eigen::Vector2d>& outline);
    bool hasOutline(const std::vector<Eigen::Vector2d>& outline, double tolerance) const;

    Eigen::AlignedBox2d bounds;
    Eigen::Vector2d center;
    double squared_inradius;  // of a circle about the center within all walls
    Walls walls;
    std::vector<Floor> floors;
  };

  void addFace(Polygon face);
  const Polygon* partInside(const Column& column, const Polygon& corners);
  void findExtremes(const Walls& walls, const Polygon& corners);
  const Polygon& partAbove(const Floor& floor, const Polygon& inside);
  static void addPrisms(const Floor& floor, const Polygon& above, SurfaceSums& sums);
  static void addPrism(const Floor& floor, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       SurfaceSums& sums);
  bool cut();

  Eigen::Matrix3d R_CT_;
  Eigen::AlignedBox3d bounds_;
  std::vector<Column> columns_;
  // Of the running call:
  std::vector<double> least_;  // of the corners, beyond each wall [m]
  std::vector<double> most_;
  Polygon inside_;           // of the walls
  Polygon kept_;             // by cut()
  std::vector<double> out_;  // for each corner of kept_: beyond what to cut at, if positive
  Polygon whole_;
};

}  // namespace sweep_guard_core
