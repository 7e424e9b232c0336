#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <memory>
#include <mutex>

#include "sweep_guard/guard/ledger.h"
#include "sweep_guard/ros/markers.h"
#include "sweep_guard/ros/parameters.h"
#include "sweep_guard/ros/view_output.h"

namespace sweep_guard_ros {

/// Keeps the newest that the guard has found, and publishes it for the eye: `~markers`, `~view` and, once, `~tool`. One
/// thread tells, another publishes.
class SceneOutput {
 public:
  SceneOutput(ros::NodeHandle private_node, const LiveParameters& parameters, const sweep_guard::Ledger& ledger);

  void passed(const sweep_guard::ToolPose& pose);
  void swept(const sweep_guard::ToolPose& pose, std::shared_ptr<const sweep_guard::SweepReport> report);
  void lookedAhead(const sweep_guard::ToolPose& from, std::shared_ptr<const sweep_guard::Outlook> outlook);
  void clear();

  void publishMarkers();     ///< if somebody listens
  void publishView() const;  ///< likewise

 private:
  MarkerScene sceneNow() const;

  const LiveParameters& parameters_;
  const sweep_guard::Ledger& ledger_;
  Markers markers_;
  ros::Publisher marker_publisher_;
  ViewOutput view_;
  mutable std::mutex mutex_;
  MarkerScene scene_;
};

}  // namespace sweep_guard_ros
