#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <sweep_guard/CheckTrajectory.h>

#include <memory>
#include <string>
#include <vector>

#include "ros/service/path_tests.h"

namespace sweep_guard_ros {

/// Returns the names in the robot description of joints that may be named as on `joint_states`.
/// @throws sweep_guard_core::InvalidInput if one could mean two joints
std::vector<std::string> namesInModel(const std::vector<std::string>& joints, const Parameters& parameters);

/// Positions of a robot's joints, one after the other.
struct PositionsRequest {
  const std::vector<std::vector<double>>& positions;  ///< of each variable [rad or m]; at least one (asserted)
  const geometry_msgs::PoseStamped& tool_pose;
  const std::vector<std::string>& mesh_ids;  ///< workpieces; all, if there are none
  double max_deviation;                      ///< of a link within a sweep [m], see robotPath()
};
/// Fills the answer but for what is to be said of the plan. Tests as checkTrajectory(), of which it is a part.
void checkPositions(PathTests& tests, const std::shared_ptr<PathQuestion>& question, const PositionsRequest& request,
                    sweep_guard::CheckTrajectory::Response& response);

/// Answers a call of `~check_trajectory`: sweeps the links of a robot, moved by their joints, against the workpieces as
/// they are now. For PathService.
void checkTrajectory(PathTests& tests, sweep_guard_core::SteadyTime arrival,
                     const sweep_guard::CheckTrajectory::Request& request,
                     sweep_guard::CheckTrajectory::Response& response);

}  // namespace sweep_guard_ros
