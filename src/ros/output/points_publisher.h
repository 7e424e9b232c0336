#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>
#include <vector>

#include "camera/depth_surface.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Publishes for displays what a camera sees, what it remembers, and what is taken for the robot: `~cameras/ID`, to subscribers, as
/// often as the markers at most. One thread.
class PointsPublisher {
 public:
  /// @param parameters  must outlive this
  PointsPublisher(ros::NodeHandle private_node, const std::string& camera, const LiveParameters& parameters);

  /// @param depths  of the newest image that the surface has taken
  void publish(const sweep_guard_core::DepthSurface& surface, const std::vector<float>& depths,
               sweep_guard_core::Time stamp);

 private:
  const LiveParameters& parameters_;
  ros::Publisher publisher_;
  sweep_guard_core::SteadyTime due_;
};

}  // namespace sweep_guard_ros
