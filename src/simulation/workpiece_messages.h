#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <vector>

#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Returns a mesh as revision 1. The caller sets header and id.
/// @param positions  of the vertices: x0 y0 z0 x1 ... [m]
sweep_guard::DeformableMesh meshMessage(const std::vector<float>& positions,
                                        const std::vector<sweep_guard_core::Triangle>& triangles);

/// Returns vertices of the same revision. The caller sets header and id.
sweep_guard::MeshVertices verticesMessage(std::vector<float> positions);

/// What a tool does to an elastic workpiece, in one frame.
struct PressedSurface {
  Eigen::Vector3d point;  ///< where the force acts [m]
  Eigen::Vector3d force;  ///< of the workpiece on the tool [N]
  double dent;            ///< [m]
};

/// Returns an arrow from the point, 0.05 m long per N, with the numbers beside it in words. Without a force
/// they are deleted.
visualization_msgs::MarkerArray forceMarkers(const std_msgs::Header& header, const PressedSurface& pressed);

}  // namespace sweep_guard_simulation
