#pragma once

#include <Eigen/Core>
#include <vector>

#include "ros/tool/tool_model.h"
#include "simulation/joint_motion.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Where an articulated tool shall meet a workpiece.
struct Meeting {
  Eigen::Vector3d p_T;          ///< the front of the tool when it meets [m], in the tool frame
  Eigen::Vector3d direction_T;  ///< [-] unit vector from where it began
};

/// Returns the meeting in the middle of the path of the last body, the one that most joints move. The path is that of the
/// center of its bounding box; what meets is its front. Downwards if it began where it is then.
/// @param model   has at least one body (asserted)
/// @param motion  not empty (asserted)
Meeting halfway(const sweep_guard_ros::RobotModel& model, const std::vector<StampedPositions>& motion);

/// Returns where in W to put a tool frame that is not turned: the tool meets the workpiece at the vertex that lies farthest
/// towards where it comes from, so that the workpiece is in front of it.
/// @param depth  [m] of that point of the tool below the vertex
Eigen::Vector3d placeToMeet(const Meeting& meeting, const sweep_guard_core::TriangleMesh& mesh_W, double depth);

}  // namespace sweep_guard_simulation
