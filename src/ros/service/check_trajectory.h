#pragma once

#include <ros/service_server.h>
#include <sweep_guard/CheckTrajectory.h>

#include "ros/service/limited_calls.h"
#include "ros/service/path_tests.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Serves `~check_trajectory`: sweeps the links of a robot, moved by their joints, against the workpieces as they are now.
/// A call that finds 4 others waiting is answered BUSY at once. A call waits and runs for no longer than its deadline.
class CheckTrajectoryService {
 public:
  /// @param tests  must outlive it
  CheckTrajectoryService(const ros::NodeHandle& private_node, ServiceThreads& threads, PathTests& tests);

 private:
  void check(const sweep_guard::CheckTrajectory::Request& request, sweep_guard::CheckTrajectory::Response& response);
  Eigen::Isometry3d toolPoseIn(const std::string& mesh_frame, const geometry_msgs::PoseStamped& pose) const;

  PathTests& tests_;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
