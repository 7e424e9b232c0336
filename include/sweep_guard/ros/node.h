#pragma once

#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <sweep_guard/Warning.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "sweep_guard/ros/check_sweep.h"
#include "sweep_guard/ros/diagnostics.h"
#include "sweep_guard/ros/markers.h"

namespace sweep_guard_ros {

/// The guard of one tool as a ROS node, and as a nodelet: inputs on threads of their own, one thread that sweeps every
/// pose, and a steady timer that warns whatever the inputs do. Topics, services and parameters: README.md.
class SweepGuardNode {
 public:
  /// @throws sweep_guard::InvalidInput if a parameter is refused, sweep_guard::DeviceError if there is no detector
  SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~SweepGuardNode();
  SweepGuardNode(const SweepGuardNode&) = delete;
  SweepGuardNode& operator=(const SweepGuardNode&) = delete;

 private:
  void enqueue(PlacedPose pose);
  void sweepPoses();
  void sweep(const PlacedPose& placed);
  void lookAhead(const PlacedPose& placed);
  void publishContacts(const sweep_guard::SweepReport& report);
  void watch();
  void watchClock();
  void warn(bool only_on_change);
  void publishMarkers();

  const Parameters parameters_;
  ros::Publisher contacts_publisher_;
  ros::Publisher warning_publisher_;
  ros::Publisher marker_publisher_;

  std::mutex warning_mutex_;
  sweep_guard::Warning warning_;  // counters and level last sent
  std::atomic<sweep_guard::SteadyTime> warned_ = sweep_guard::SteadyTime();
  sweep_guard::Time clock_seen_;

  std::mutex queue_mutex_;
  std::condition_variable queue_changed_;
  std::deque<PlacedPose> queue_;
  bool stopping_ = false;

  std::mutex scene_mutex_;
  MarkerScene scene_;

  // What follows calls back on what stands above.
  sweep_guard::Ledger ledger_;
  sweep_guard::Guard guard_;           // of the sweeping thread
  std::uint64_t guard_epoch_ = 0;      // of the sweeping thread
  sweep_guard::SteadyTime predicted_;  // of the sweeping thread
  LogThrottle log_;                    // of the sweeping thread
  Frames frames_;
  WorkpieceStore workpieces_;
  PoseInput poses_;
  MeshInput meshes_;
  CheckSweepService check_sweep_;
  Workload workload_;
  Diagnostics diagnostics_;
  Markers markers_;

  QueueThread warning_thread_;
  QueueThread report_thread_;
  ros::SteadyTimer warning_timer_;
  ros::SteadyTimer marker_timer_;
  ros::SteadyTimer diagnostics_timer_;
  std::thread sweeping_thread_;
};

}  // namespace sweep_guard_ros
