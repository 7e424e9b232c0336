#pragma once

#include <ros/node_handle.h>

#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Publishes for those behind motion_guard whether the guard knows: `~velocity_scale`, 1 or else 0, and `~lock`, false or
/// else true, for a lock of twist_mux. Both follow the zero that motion_guard sends: a locked twist_mux would keep it back.
/// Not thread-safe.
class HoldPublisher {
 public:
  explicit HoldPublisher(ros::NodeHandle private_node);

  /// To be called 50 times a second. Holds once commands have not been let through for as long as they take to be heard.
  void publish(bool lets_through, sweep_guard_core::SteadyTime now);
  void hold();  ///< at once

 private:
  void send(bool holds);

  bool lets_through_ = false;
  std::optional<sweep_guard_core::SteadyTime> changed_;  // since the beginning: nothing was let through before
  ros::Publisher velocity_scale_;
  ros::Publisher lock_;
};

}  // namespace sweep_guard_ros
