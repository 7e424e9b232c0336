#pragma once

#include <ros/service_server.h>
#include <sweep_guard/CheckSweep.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>

#include "guard/workpiece_store.h"
#include "ros/input/frames.h"
#include "ros/parameters/parameters.h"
#include "ros/service/limited_calls.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Serves `~check_sweep`: sweeps a path of poses against the workpieces as they are now. Has its own thread and
/// detectors and works on a snapshot of the meshes, so it never delays the guard. A call that finds 4 others waiting is
/// answered BUSY at once, and a call is given up at its deadline.
class CheckSweepService {
 public:
  CheckSweepService(const ros::NodeHandle& private_node, const LiveParameters& live, const Frames& frames,
                    const sweep_guard_core::WorkpieceStore& workpieces,
                    const sweep_guard_core::WarningMonitor& monitor);

  ~CheckSweepService() { stopping_ = true; }
  CheckSweepService(const CheckSweepService&) = delete;
  CheckSweepService& operator=(const CheckSweepService&) = delete;

  void start(Supervisor& supervisor) { calls_.start(supervisor); }

 private:
  bool onCall(sweep_guard::CheckSweep::Request& request, sweep_guard::CheckSweep::Response& response);
  void refreshParameters();
  void check(const sweep_guard::CheckSweep::Request& request, sweep_guard::CheckSweep::Response& response);
  std::function<void(const std::string& where)> untilDeadline() const;
  sweep_guard_core::Workpieces selected(const std::vector<std::string>& ids) const;
  std::vector<Eigen::Isometry3d> pathIn(const std::string& mesh_frame,
                                        const std::vector<geometry_msgs::PoseStamped>& path,
                                        const std::function<void(const std::string& where)>& go_on) const;
  std::string oldTransforms(const sweep_guard::CheckSweep::Request& request) const;
  sweep_guard_core::Detector& detector(const std::string& name);

  const LiveParameters& live_;
  std::shared_ptr<const Parameters> parameters_;  // of the newest call
  const Frames& frames_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  const sweep_guard_core::WarningMonitor& monitor_;
  std::map<std::string, std::unique_ptr<sweep_guard_core::Detector>> detectors_;  // by name, made on demand
  std::atomic<bool> stopping_ = false;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
