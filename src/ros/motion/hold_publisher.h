#pragma once

#include <ros/node_handle.h>

#include <atomic>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Publishes for those behind motion_guard whether the guard knows: `~velocity_scale`, 1 or else 0, for MoveIt Servo's
/// ~internal/collision_velocity_scale, and `~lock`, false or else true, for a lock of twist_mux.
class HoldPublisher {
 public:
  explicit HoldPublisher(ros::NodeHandle private_node);

  void publish(bool lets_through, sweep_guard_core::SteadyTime now);  ///< to be called 50 times a second

  /// Returns whether those behind motion_guard have had time to hear that it lets commands through: MoveIt Servo stays
  /// halted, until its status is reset, if a scale of 0 meets another command than zero. Any thread.
  bool released(sweep_guard_core::SteadyTime now) const;

 private:
  static constexpr sweep_guard_core::SteadyTime kHeld = sweep_guard_core::SteadyTime::max();

  std::atomic<sweep_guard_core::SteadyTime> released_since_ = kHeld;
  ros::Publisher velocity_scale_;
  ros::Publisher lock_;
};

}  // namespace sweep_guard_ros
