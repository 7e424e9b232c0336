#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <memory>
#include <mutex>

#include "ros/output/markers.h"
#include "ros/output/view_publisher.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Keeps the newest that the guard has found, and publishes it for the eye: `~markers`, `~view` and, once, `~tool`. One
/// thread tells, another publishes.
class ScenePublisher {
 public:
  ScenePublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                 const sweep_guard_core::WarningMonitor& monitor);

  void passed(const sweep_guard_core::PoseWithFrames& pose);
  void swept(const sweep_guard_core::PoseWithFrames& pose, std::shared_ptr<const sweep_guard_core::SweepReport> report);
  void predicted(const sweep_guard_core::PoseWithFrames& from,
                 std::shared_ptr<const sweep_guard_core::Prediction> prediction);
  void clear();

  void publishMarkers();     ///< if somebody listens
  void publishView() const;  ///< likewise

 private:
  MarkerScene sceneNow() const;

  const LiveParameters& parameters_;
  const sweep_guard_core::WarningMonitor& monitor_;
  Markers markers_;
  ros::Publisher marker_publisher_;
  ViewPublisher view_;
  mutable std::mutex mutex_;
  MarkerScene scene_;
};

}  // namespace sweep_guard_ros
