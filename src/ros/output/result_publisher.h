#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/parameters/live_parameters.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_ros {

/// Publishes the results of every sweep and every prediction, each where there is a subscriber: `~contacts`, `~prediction` and
/// `~time_to_collision`.
class ResultPublisher {
 public:
  ResultPublisher(ros::NodeHandle private_node, const LiveParameters& parameters);

  void publish(const sweep_guard_core::SweepReport& report) const;
  /// @param age  age that the first pose had at the time of the prediction
  void publish(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age) const;

 private:
  const LiveParameters& parameters_;
  ros::Publisher contacts_publisher_;
  ros::Publisher prediction_publisher_;
  ros::Publisher time_to_collision_publisher_;
};

}  // namespace sweep_guard_ros
