#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Returns the highest point of the triangles of a workpiece [m], along z of the fixed frame W, in which the mesh is.
Eigen::Vector3d highestPoint(const sweep_guard_core::TriangleMesh& mesh_W);

/// Returns the height of a workpiece [m] as seen from above at (x, y); empty: no surface there.
std::optional<double> surfaceHeight(const sweep_guard_core::TriangleMesh& mesh_W, double x, double y);

/// Moves a drill over a workpiece from hole to hole, as a smooth function of time. Above the workpiece the drill
/// wanders and tilts in all six degrees of freedom. It comes down steadily onto the next hole, plunges, rests in it,
/// and retracts. The tool frame T has its origin at the tip and z out of the tip; the drill plunges along -z of the
/// fixed frame W.
class Drilling {
 public:
  struct Options {
    double clearance = 0.08;     ///< [m] > 0; height of the tip above the surface between two holes
    double depth = 0.010;        ///< [m] >= 0; depth of the tip below the surface in the hole
    double wander = 0.015;       ///< [m] >= 0; largest deviation of the tip along each axis between two holes
    double tilt = 0.25;          ///< [rad] in [0, 1]; largest component of the rotation vector between two holes
    double travel_time = 2.0;    ///< [s] > 0; from above one hole to above the next hole
    double approach_time = 1.5;  ///< [s] > 0; down to the bottom of the hole, and up again
    double dwell_time = 0.4;     ///< [s] >= 0; at the bottom of the hole
  };

  /// @param holes_W  points of the surface [m], drilled in this order
  /// @throws sweep_guard_core::InvalidInput if there is no hole or an option is out of range
  Drilling(std::vector<Eigen::Vector3d> holes_W, const Options& options);

  Eigen::Isometry3d pose(double t) const;  ///< X_WT at t [s] >= 0; starts above the last hole and repeats forever
  double duration() const;                 ///< [s] of one round over all holes

 private:
  double holeTime() const;
  double heightAt(double t_hole) const;

  std::vector<Eigen::Vector3d> holes_W_;
  Options options_;
};

/// Returns points of the surface for holes: the highest point, and points on a circle around it.
/// @param radius  of the circle [m]
/// @param count   of points on the circle, >= 0; those without a surface, or more than `radius` below the highest
///     point, are left out
std::vector<Eigen::Vector3d> holesAround(const sweep_guard_core::TriangleMesh& mesh_W, double radius, int count);

}  // namespace sweep_guard_simulation
