#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "simulation/top_surface.h"

namespace sweep_guard_simulation {

/// A drill that an operator leads over a workpiece from hole to hole, as a smooth function of time: it wanders and
/// turns above the workpiece in all six degrees of freedom, comes down steadily onto the next hole, plunges, rests in
/// it, and retracts. The tool frame T has its origin at the tip and z out of the tip; drilling goes along -z of the
/// fixed frame W.
class Drilling {
 public:
  struct Options {
    double clearance = 0.08;     ///< [m] > 0; tip above the surface between two holes
    double depth = 0.010;        ///< [m] >= 0; tip below the surface in the hole
    double wander = 0.015;       ///< [m] >= 0; the tip strays by at most this along each axis between two holes
    double tilt = 0.25;          ///< [rad] in [0, 1]; each component of the rotation vector strays by at most this
    double travel_time = 2.0;    ///< [s] > 0; from above one hole to above the next
    double approach_time = 1.5;  ///< [s] > 0; down to the surface and into it; the same back up
    double dwell_time = 0.4;     ///< [s] >= 0; at the bottom of the hole
  };

  /// @param holes_W  points of the surface [m], drilled in this order
  /// @throws sweep_guard_core::InvalidInput if there is no hole or an option is out of range
  Drilling(std::vector<Eigen::Vector3d> holes_W, const Options& options);

  Eigen::Isometry3d pose(double t) const;  ///< X_WT at t [s] >= 0; begins above the last hole and goes round for ever
  double duration() const;                 ///< [s] of one round over all holes

 private:
  double holeTime() const;
  double heightAt(double t_hole) const;

  std::vector<Eigen::Vector3d> holes_W_;
  Options options_;
};

/// Points of the surface for holes: the highest one and those found around it on a circle.
/// @param radius  of the circle [m]
/// @param count   of points on it, >= 0; left out where the surface is missing or more than `radius` below the highest
/// point
std::vector<Eigen::Vector3d> holesAround(const TopSurface& surface, double radius, int count);

}  // namespace sweep_guard_simulation
