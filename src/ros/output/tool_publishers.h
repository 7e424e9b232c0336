#pragma once

#include <boost/shared_ptr.hpp>

#include "ros/output/bodies_publisher.h"
#include "ros/output/interaction_publisher.h"
#include "ros/output/proximity_publisher.h"

namespace sweep_guard_ros {

/// What the publishers need of another tool.
struct ToolShapes {
  /// Any thread. Takes seconds for ten thousand corners.
  explicit ToolShapes(const Parameters& parameters);

  sweep_guard_core::InterpenetrationFinders pieces;
  boost::shared_ptr<sweep_guard::ToolSurface> surface;
};

/// Publishes what is known of the tool beside warnings, at every swept pose. One thread.
struct ToolPublishers {
  ToolPublishers(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                 const sweep_guard_core::WarningMonitor& monitor);

  /// Exchanges the tool.
  /// @param shapes  of the same parameters; those before when it returns
  void setTool(const Parameters& parameters, ToolShapes& shapes);

  void reset();  ///< forgets all motion

  ProximityPublisher proximity;
  InteractionPublisher interaction;
  BodiesPublisher bodies;
};

}  // namespace sweep_guard_ros
