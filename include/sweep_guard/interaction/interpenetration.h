#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// What a convex piece of the tool and a workpiece have in common, at one pose, in the tool frame T.
///
/// Of a mesh that encloses something (TriangleMesh::closed()) the volume is that of the piece inside of the
/// mesh. Each triangle is swept against one direction fixed in T, clipped to the piece, and counted by the side to
/// which it faces: the sum needs neither caps nor an inside test, also where the piece touches no triangle. Where the
/// mesh intersects itself, volume counts as often as it is enclosed.
///
/// Of any other mesh it is the volume behind the triangles that the piece touches: their parts inside the piece are
/// swept against `area_T` to the far side of the piece. Their front is where their corners are counter-clockwise.
struct Interpenetration {
  double volume = 0.0;                                   ///< [m^3], >= 0
  Eigen::Vector3d centroid_T = Eigen::Vector3d::Zero();  ///< of the volume [m]; the origin if there is none
  /// Integral of the outward unit normal over the surface of the workpiece inside the piece [m^2]: points out of the
  /// workpiece, and is zero where the piece pierces it.
  Eigen::Vector3d area_T = Eigen::Vector3d::Zero();
  bool enclosed = false;  ///< the mesh encloses something; false: the volume is that behind the touched triangles

  /// How far the piece reaches behind the mean of the surface inside of it, against area_T [m]: 0 to the size of the
  /// piece; 0 without an area. Where the piece pierces the workpiece, area_T is short and this jumps: depth() does not.
  double reach = 0.0;

  /// Returns `reach` [m], times the share of the area in a least one if it is below this.
  /// @param least_area  [m^2], > 0 (asserted)
  double depth(double least_area) const;
};

/// Computes the interpenetration of a convex piece with meshes. Keeps its buffers between calls: with a mesh that
/// encloses something, nothing is allocated in steady state. Its time grows with the triangles that the piece touches
/// or that lie beyond it along its longest side.
///
/// A cylinder counts as a prism of as many sides as its mesh_T(), of the same cross-section. A padded hull or box keeps
/// sharp edges. Other padded bodies count as polyhedra with 114 directions: of a sphere it has the volume, of a capsule
/// up to 6 % less. A flat piece has no volume.
class InterpenetrationFinder {
 public:
  explicit InterpenetrationFinder(const ConvexShape& shape_T);
  ~InterpenetrationFinder();
  InterpenetrationFinder(InterpenetrationFinder&& other) noexcept;
  InterpenetrationFinder& operator=(InterpenetrationFinder&& other) noexcept;

  /// @param X_MT  finite pose of the tool [m]; not checked
  Interpenetration find(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT);

  double pieceVolume() const;  ///< of the polyhedron that stands for the piece [m^3]; 0 if the piece is flat

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sweep_guard_core
