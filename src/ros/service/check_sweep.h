#pragma once

#include <ros/service_server.h>
#include <sweep_guard/CheckSweep.h>

#include <string>
#include <vector>

#include "ros/service/limited_calls.h"
#include "ros/service/path_tests.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Serves `~check_sweep`: sweeps a path of poses against the workpieces as they are now. A call that finds 4 others waiting
/// is answered BUSY at once. A call waits and runs for no longer than its deadline.
class CheckSweepService {
 public:
  /// @param tests  must outlive it
  CheckSweepService(const ros::NodeHandle& private_node, ServiceThreads& threads, PathTests& tests);

 private:
  void check(const sweep_guard::CheckSweep::Request& request, sweep_guard::CheckSweep::Response& response);
  std::vector<Eigen::Isometry3d> pathIn(const std::string& mesh_frame,
                                        const std::vector<geometry_msgs::PoseStamped>& path, const GoOn& go_on) const;

  PathTests& tests_;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
