#pragma once

#include <ros/node_handle.h>

namespace sweep_guard_ros {

/// Publishes for those behind motion_guard whether the guard knows: `~velocity_scale`, 1 or else 0, for MoveIt Servo's
/// ~internal/collision_velocity_scale, and `~lock`, false or else true, for a lock of twist_mux.
class HoldPublisher {
 public:
  explicit HoldPublisher(ros::NodeHandle private_node);

  void publish(bool lets_through);  ///< to be called 50 times a second

 private:
  ros::Publisher velocity_scale_;
  ros::Publisher lock_;
};

}  // namespace sweep_guard_ros
