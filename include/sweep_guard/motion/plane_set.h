#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// The surfaces around the tool at one swept pose, as far as a motion guard knows them.
struct PlaneSet {
  Timestamps timestamps;                                   ///< stamp of the swept pose
  Time valid_until;                                        ///< by the clock of the stamps
  bool complete = false;                                   ///< every workpiece was tested at that pose
  std::uint32_t tool_revision = 0;                         ///< of the ToolBalls that SeparatingPlane::piece refers to
  std::vector<SeparatingPlane> planes;                     ///< nearest first
  UncoveredSurfaces uncovered;                             ///< what no plane stands for
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the swept pose
  std::vector<std::string> joints = {};                    ///< that place the bodies of the tool; none: it is rigid
  std::vector<double> positions = {};                      ///< of each at the swept pose [rad or m]
};

/// The convex pieces of a tool, each as balls whose convex hull contains it.
struct ToolBalls {
  std::uint32_t revision = 0;                 ///< another one for each tool, and in each run of the guard
  std::vector<std::vector<ToolBall>> pieces;  ///< in the frame of their body
  std::vector<std::string> frames = {};       ///< of each piece: link whose frame it is; empty: the tool frame
};

/// Returns an upper bound on the distance of any tool point from `p_T` [m].
double radiusAbout(const Eigen::Vector3d& p_T, const ToolBalls& tool);

/// Returns whether each plane belongs to a piece of this tool.
bool belongsTo(const PlaneSet& planes, const ToolBalls& tool);

/// Returns an upper bound on the displacement of any tool point from one pose to another [m].
/// @param radius  largest distance of a tool point from the origin of the tool frame [m]
double largestDisplacement(const Eigen::Isometry3d& from_WT, const Eigen::Isometry3d& to_WT, double radius);

/// Returns whether a surface lies between two poses: a piece that is before its plane at the first one reaches beyond it at
/// the other one, or some tool point may reach what no plane stands for.
/// @param planes  belong to the tool (belongsTo())
bool passesASurface(const PlaneSet& planes, const ToolBalls& tool, const Eigen::Isometry3d& from_WT,
                    const Eigen::Isometry3d& to_WT);

/// @throws InvalidInput  if a value is not finite or out of range, with what it is
void requireUsable(const PlaneSet& planes);
void requireUsable(const ToolBalls& tool);

}  // namespace sweep_guard_core
