#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>

namespace sweep_guard_simulation {

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
