#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <tf2_ros/buffer.h>

#include <Eigen/Geometry>
#include <string>

#include "simulation/guided_tip.h"

namespace sweep_guard_simulation {

/// Guides a tip by an interactive marker that the user drags and turns in rviz.
class MarkerGuide {
 public:
  /// @param topic   namespace of the marker's topics
  /// @param frame   fixed frame W; rviz may use another one
  /// @param X_WTip  first pose of the marker
  MarkerGuide(const std::string& topic, const std::string& frame, const Eigen::Isometry3d& X_WTip,
              const tf2_ros::Buffer& buffer);

  void move(GuidedTip& tip, double dt) const { tip.moveTowards(goal_W_, dt); }

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;
  void onFeedback(const Feedback::ConstPtr& feedback);

  std::string frame_;
  Eigen::Isometry3d goal_W_;
  const tf2_ros::Buffer& buffer_;
  interactive_markers::InteractiveMarkerServer server_;
};

}  // namespace sweep_guard_simulation
