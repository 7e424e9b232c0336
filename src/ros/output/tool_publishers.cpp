#include "ros/output/tool_publishers.h"

namespace sweep_guard_ros {

ToolShapes::ToolShapes(const Parameters& parameters)
    : pieces(sweep_guard_core::interpenetrationFinders(*parameters.bodies)), surface(surfaceMsg(parameters)) {}

ToolPublishers::ToolPublishers(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                               const sweep_guard_core::WarningMonitor& monitor)
    : proximity(private_node, parameters, monitor),
      interaction(private_node, parameters, monitor),
      bodies(private_node, parameters) {}

void ToolPublishers::setTool(const Parameters& parameters, ToolShapes& shapes) {
  proximity.setTool(*parameters.tool);
  interaction.exchange(shapes.pieces);
  bodies.setTool(*parameters.bodies, shapes.surface);
}

void ToolPublishers::reset() {
  proximity.reset();
  interaction.reset();
  bodies.reset();
}

}  // namespace sweep_guard_ros
