#pragma once

#include <ros/node_handle.h>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Lets the device in the operator's hand rumble while a motion guard holds the robot back: on `~feedback`, as joy_node reads
/// it on `joy/set_feedback`. Not thread-safe.
class Rumble {
 public:
  /// @param id         of the motor
  /// @param intensity  where all of a command is held back, in [0, 1]
  Rumble(ros::NodeHandle private_node, int id, double intensity);
  ~Rumble();  ///< sends 0 if it rumbles

  /// Publishes on change, and four times a second: a driver may let it end after a second.
  /// @param share  of the command that is held back, in [0, 1]
  void update(double share, sweep_guard_core::SteadyTime now);

 private:
  const int id_;
  const double intensity_;
  ros::Publisher publisher_;
  double sent_ = 0.0;
  sweep_guard_core::SteadyTime sent_at_{};
};

}  // namespace sweep_guard_ros
