#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/ros/parameters.h"

namespace sweep_guard_ros {

/// Publishes what every sweep and every look ahead has found: `~contacts`, `~prediction` and `~time_to_collision`.
class FindingsOutput {
 public:
  FindingsOutput(ros::NodeHandle private_node, const LiveParameters& parameters);

  /// @param tool  that was swept
  void publish(const sweep_guard::SweepReport& report, const sweep_guard::Tool& tool) const;
  /// @param age  of the pose that the outlook begins at, at the moment of the prediction
  void publish(const sweep_guard::Outlook& outlook, sweep_guard::Duration age) const;

 private:
  const LiveParameters& parameters_;
  ros::Publisher contacts_publisher_;
  ros::Publisher prediction_publisher_;
  ros::Publisher time_to_collision_publisher_;
};

}  // namespace sweep_guard_ros
