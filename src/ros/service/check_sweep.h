#pragma once

#include <ros/service_server.h>
#include <sweep_guard/CheckSweep.h>

#include <atomic>
#include <string>
#include <vector>

#include "guard/workpiece_store.h"
#include "ros/input/frames.h"
#include "ros/parameters/parameters.h"
#include "ros/process.h"
#include "ros/service/limited_calls.h"
#include "ros/service/path_tester.h"
#include "ros/threads/background_thread.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

struct CheckSweepDependencies {
  const LiveParameters& parameters;
  const Frames& frames;
  const sweep_guard_core::WorkpieceStore& workpieces;
  const sweep_guard_core::WarningMonitor& monitor;
  MakeDetector make_detector = sweep_guard_core::makeDetector;
};

/// Serves `~check_sweep`: sweeps a path of poses against the workpieces as they are now. Has its own threads and
/// detectors and works on a snapshot of the meshes, so it never delays the guard. A call that finds 4 others waiting is
/// answered BUSY at once. A call waits and runs for no longer than its deadline.
class CheckSweepService {
 public:
  CheckSweepService(const ros::NodeHandle& private_node, const CheckSweepDependencies& dependencies);

  ~CheckSweepService() { stopping_ = true; }
  CheckSweepService(const CheckSweepService&) = delete;
  CheckSweepService& operator=(const CheckSweepService&) = delete;

  void start(Supervisor& supervisor);

 private:
  bool onCall(sweep_guard::CheckSweep::Request& request, sweep_guard::CheckSweep::Response& response);
  void check(const sweep_guard::CheckSweep::Request& request, sweep_guard::CheckSweep::Response& response);
  std::vector<sweep_guard_core::PathResult> test(const std::shared_ptr<const PathQuestion>& question);
  GoOn untilDeadline(sweep_guard_core::Duration deadline) const;
  sweep_guard_core::Workpieces selected(const std::vector<std::string>& ids) const;
  std::vector<Eigen::Isometry3d> pathIn(const std::string& mesh_frame,
                                        const std::vector<geometry_msgs::PoseStamped>& path, const GoOn& go_on) const;
  std::string doubts(const PathQuestion& question, const sweep_guard::CheckSweep::Request& request) const;
  std::string oldTransforms(const PathQuestion& question, const sweep_guard::CheckSweep::Request& request) const;

  const CheckSweepDependencies dependencies_;
  PathTester tester_;
  std::atomic<bool> stopping_ = false;
  BackgroundThread sweeps_{[] { setNice(10); }};
  LimitedCalls calls_{"check_sweep"};  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
