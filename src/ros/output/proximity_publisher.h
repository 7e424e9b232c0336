#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/output/known_surfaces.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_ros {

/// Publishes the separating planes at every swept pose, `~proximity`, and the tool that they refer to, `~tool_balls`. One
/// thread calls it.
class ProximityPublisher {
 public:
  ProximityPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                     const sweep_guard_core::WarningMonitor& monitor);

  /// Publishes the tool that the next planes refer to.
  void setTool(const Parameters& parameters);

  /// Computes and publishes the planes, if there is a subscriber and a reach.
  /// @param report  of the sweep to the pose
  /// @param guard   that made it
  void swept(const sweep_guard_core::PoseWithFrames& pose, const sweep_guard_core::Workpieces& workpieces,
             const sweep_guard_core::SweepReport& report, const sweep_guard_core::Guard& guard);

  void reset() { finder_.reset(); }  ///< forgets the motion of the surfaces

 private:
  const LiveParameters& parameters_;
  KnownSurfaces known_surfaces_;
  ros::Publisher planes_publisher_;
  ros::Publisher tool_publisher_;
  std::uint32_t tool_revision_;  // those of another run are others, too
  sweep_guard_core::ProximityFinder finder_;
  sweep_guard_core::Proximity proximity_;
};

}  // namespace sweep_guard_ros
