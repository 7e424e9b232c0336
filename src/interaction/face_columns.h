#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "interaction/outline.h"
#include "interaction/piece_polytope.h"
#include "interaction/polygon_cutter.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Integrals over a surface and over the volume of the vertical prisms below it. Surfaces that face down count negative
/// for the volume: of a closed surface remains what it encloses.
struct SurfaceSums {
  double volume = 0.0;                                      ///< [m^3]
  Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero();  ///< of the position over the volume [m^4]
  Eigen::Vector3d area = Eigen::Vector3d::Zero();           ///< of the normal over the surface [m^2]
  Eigen::Matrix3d area_moment = Eigen::Matrix3d::Zero();    ///< of position times transposed normal [m^3]
};

/// Sums the integrals over prisms, many of them at once.
class PrismAccumulator {
 public:
  /// Begins with sums of 0.
  void begin();

  /// Adds the prism below a triangle.
  /// @param corners  counter-clockwise seen from the side of the normal [m]
  /// @param heights  of the corners above the floor of the prism [m]
  void add(const std::array<const Eigen::Vector3d*, 3>& corners, const std::array<double, 3>& heights);

  SurfaceSums sums();

 private:
  void addBatch();

  simd::PrismBatch batch_;
  simd::PrismSums sums_;
};

inline void PrismAccumulator::add(const std::array<const Eigen::Vector3d*, 3>& corners,
                                  const std::array<double, 3>& heights) {
  if (batch_.count == simd::kPrisms) addBatch();
  const size_t at = batch_.count++;
  for (size_t i = 0; i < 3; ++i) {
    batch_.corner[i][0][at] = corners[i]->x();
    batch_.corner[i][1][at] = corners[i]->y();
    batch_.corner[i][2][at] = corners[i]->z();
    batch_.height[i][at] = heights[i];
  }
}

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

  /// Adds the prisms between the part of a triangle inside the polytope and above it, and the faces below.
  /// @param triangle  corners, counter-clockwise seen from the side of the normal [m]
  void add(const std::array<Eigen::Vector3d, 3>& triangle, PrismAccumulator& prisms);

 private:
  struct Floor {  // the plane of a face: z = x * p.x + y * p.y + d
    double x;
    double y;
    double d;
    bool looks_down;
    double lowest;  // point of the face
    double highest;
    double height(const Eigen::Vector3d& p) const { return p.z() - (x * p.x() + y * p.y() + d); }
  };
  struct Column {
    Outline outline;
    std::vector<Floor> floors;
  };

  void addFace(Polygon face);
  const Polygon& partAbove(const Floor& floor);
  static void addFan(const Floor& floor, const Polygon& above, PrismAccumulator& prisms);

  Eigen::Matrix3d R_CT_;
  Eigen::AlignedBox3d bounds_;
  std::vector<Column> columns_;
  PolygonCutter inside_;  // of the walls; of the running call
  PolygonCutter above_;   // of a floor
};

}  // namespace sweep_guard_core
