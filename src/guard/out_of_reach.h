#pragma once

#include <Eigen/Geometry>

#include "guard/moving_mesh.h"
#include "guard/pose_history.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// Returns whether no point of a box comes nearer to the box around a mesh than a distance [m], whatever the rounding.
bool staysBeside(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& points_M, double distance);

/// Returns whether no volume of a piece of a tool that moves through some poses reaches the box around a mesh, as a bound tells before
/// there is a volume.
///
/// The box of a volume has three axes at right angles. Along each of them, it reaches from the middle of the chord of the tool's
/// center by at most the radius of the tool about its center, the growth of the volume, and what the chord and the mesh
/// translation contribute. So no point of the volume is farther from there than half of the chord and of the translation, and
/// sqrt(3) times the rest. The middle is within half of the translation, and the deviation, of the box around the center at the
/// poses.
/// @param poses   of the center of bounds_T()
/// @param margin  of each volume beside the motion of tool and mesh [m], >= 0
bool staysOutOfReach(const Tool& tool, const PoseBounds& poses, const MovingMesh& mesh, double margin);

}  // namespace sweep_guard_core
