#pragma once

#include <ros/node_handle.h>
#include <sweep_guard/ToolShape.h>
#include <sweep_guard/View.h>

#include <string>

#include "ros/output/markers.h"

namespace sweep_guard_ros {

/// Converts what the markers show. The caller sets frame and tool.
/// @param scene  must have its tool
sweep_guard::View toMsg(const MarkerScene& scene);
sweep_guard::ToolShape toMsg(
    const std::vector<sweep_guard_core::Tool>& bodies);  ///< converts the tool without its padding

/// Publishes `~view` and, once and for each other tool, `~tool`, for displays that draw the workpiece themselves.
class ViewPublisher {
 public:
  ViewPublisher(ros::NodeHandle private_node, std::string fixed_frame, std::string tool_frame,
                const std::vector<sweep_guard_core::Tool>& bodies);

  bool hasSubscribers() const { return view_publisher_.getNumSubscribers() > 0; }
  void publish(const MarkerScene& scene) const;
  void publishTool(const std::vector<sweep_guard_core::Tool>& bodies) const;

 private:
  const std::string fixed_frame_;
  const std::string tool_frame_;
  ros::Publisher view_publisher_;
  ros::Publisher tool_publisher_;
};

}  // namespace sweep_guard_ros
