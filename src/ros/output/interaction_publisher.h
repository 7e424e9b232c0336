#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/output/known_surfaces.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/interaction/interaction_finder.h"

namespace sweep_guard_ros {

/// Publishes the force of the workpieces on the tool at every swept pose, `~interaction`. One thread calls it.
class InteractionPublisher {
 public:
  InteractionPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                       const sweep_guard_core::WarningMonitor& monitor);

  /// Exchanges the pieces of the tool; the caller gets those before.
  void exchange(sweep_guard_core::InterpenetrationFinders& bodies) { finder_.exchange(bodies); }

  /// Computes and publishes the force, if there is a subscriber.
  /// @param report  of the sweep to the pose
  void swept(const sweep_guard_core::PoseWithFrames& pose, const sweep_guard_core::Workpieces& workpieces,
             const sweep_guard_core::SweepReport& report);

  void reset() { finder_.reset(); }  ///< forgets the motion of the tool

 private:
  const LiveParameters& parameters_;
  KnownSurfaces known_surfaces_;
  ros::Publisher publisher_;
  sweep_guard_core::InteractionFinder finder_;
  sweep_guard_core::Interaction interaction_;
};

}  // namespace sweep_guard_ros
