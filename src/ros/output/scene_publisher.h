#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <memory>

#include "common/guarded_by.h"
#include "guard/workpiece_store.h"
#include "ros/output/markers.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Keeps the newest results of the guard and publishes them for displays: `~markers`, `~view`, and `~tool`, latched. One
/// thread reports results, another one publishes.
class ScenePublisher {
 public:
  /// All must outlive this.
  /// @param workpieces  used from publishMarkers() on
  ScenePublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                 const sweep_guard_core::WarningMonitor& monitor, const sweep_guard_core::WorkpieceStore& workpieces);

  void passed(const sweep_guard_core::PoseWithFrames& pose);
  void swept(const sweep_guard_core::PoseWithFrames& pose, std::shared_ptr<const sweep_guard_core::SweepReport> report);
  void predicted(const sweep_guard_core::PoseWithFrames& from,
                 std::shared_ptr<const sweep_guard_core::Prediction> prediction);
  void clear();
  void setTool(const std::vector<sweep_guard_core::Tool>& bodies);  ///< publishes `~tool` anew

  void publishMarkers();     ///< publishes if there is a subscriber
  void publishView() const;  ///< publishes if there is a subscriber

 private:
  MarkerScene currentScene() const;

  const LiveParameters& parameters_;
  const sweep_guard_core::WarningMonitor& monitor_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  Markers markers_;
  ros::Publisher marker_publisher_;
  ros::Publisher view_publisher_;
  ros::Publisher tool_publisher_;
  mutable sweep_guard_core::Mutex mutex_;
  MarkerScene scene_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
