#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "ros/tool/tool_model.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/kinematics/joint_timeline.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_simulation {

using sweep_guard_core::StampedPositions;

/// Reads the motion of a robot's joints from the sensor_msgs/JointState of a rosbag, which may come from several nodes, each
/// with joints of its own. The motion begins when all joints are known, and ends when the first of them ends.
/// @param topic         empty: the only topic with JointState
/// @param fixed_joints  positions [rad or m] of joints that the bag need not have
/// @param joint_names   names of joints in the tree, by their names in the bag; the others have the same name
/// @returns a state at each stamp of any joint, at least one, in the order of their stamps
/// @throws sweep_guard_core::InvalidInput as readJointBag() does, if the bag has no position of a joint, or if
///     JointTimeline refuses a message
std::vector<StampedPositions> readJointMotion(const std::string& path, const std::string& topic,
                                              const sweep_guard_core::KinematicTree& tree,
                                              const std::map<std::string, double>& fixed_joints,
                                              const std::map<std::string, std::string>& joint_names = {});

/// Where an articulated tool is to meet a workpiece.
struct Meeting {
  Eigen::Vector3d p_T;          ///< the front of the tool when it meets [m], in the tool frame
  Eigen::Vector3d direction_T;  ///< [-] unit vector from where it began
};

/// Returns the meeting in the middle of the path of the last body, the one that most joints move. The path is that of
/// the center of its bounding box; its front meets the workpiece. The direction is downwards if the body has not moved
/// by then.
/// @param model   has at least one body (asserted)
/// @param motion  not empty (asserted)
Meeting halfway(const sweep_guard_ros::RobotModel& model, const std::vector<StampedPositions>& motion);

/// Returns where in W to put a tool frame that is not turned: the tool meets the workpiece at the vertex that lies farthest
/// towards where it comes from, so that the workpiece is in front of it.
/// @param depth  [m] of that point of the tool below the vertex
Eigen::Vector3d placeToMeet(const Meeting& meeting, const sweep_guard_core::TriangleMesh& mesh_W, double depth);

}  // namespace sweep_guard_simulation
