#include "simulation/marker_guide.h"

#include <tf2_eigen/tf2_eigen.h>

#include <array>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;

namespace {

constexpr double kMarkerReminder = 5.0;  // [s]
constexpr float kSize = 0.2F;            // [m] larger than the tool, smaller than the view of rviz

// rviz uses the x axis of the control's orientation.
InteractiveMarkerControl control(const std::string& name, std::uint8_t mode, const Eigen::Vector3d& axis) {
  InteractiveMarkerControl control;
  control.name = name;
  control.interaction_mode = mode;
  control.orientation = tf2::toMsg(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), axis));
  return control;
}

InteractiveMarker sixDofMarker(const std::string& frame, const Eigen::Isometry3d& X_WTip) {
  InteractiveMarker marker;
  marker.header.frame_id = frame;
  marker.name = "tip";
  marker.description = "drag and turn the tip";
  marker.scale = kSize;
  marker.pose = sweep_guard_ros::toMsg(X_WTip);
  const std::array<std::string, 3> names = {"x", "y", "z"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    marker.controls.push_back(control("move_" + name, InteractiveMarkerControl::MOVE_AXIS, axis));
    marker.controls.push_back(control("turn_" + name, InteractiveMarkerControl::ROTATE_AXIS, axis));
  }
  return marker;
}

}  // namespace

MarkerGuide::MarkerGuide(const std::string& topic, const std::string& frame, const Eigen::Isometry3d& X_WTip,
                         const tf2_ros::Buffer& buffer)
    : frame_(frame), goal_W_(X_WTip), buffer_(buffer), server_(topic) {
  server_.insert(sixDofMarker(frame, X_WTip), [this](const Feedback::ConstPtr& feedback) { onFeedback(feedback); });
  server_.applyChanges();
  ROS_INFO("guide the tool with the marker on %s: in rviz, choose Interact and drag it", topic.c_str());
}

void MarkerGuide::onFeedback(const Feedback::ConstPtr& feedback) {
  if (feedback->event_type != Feedback::POSE_UPDATE) return;
  try {
    const Eigen::Isometry3d X_WF =
        tf2::transformToEigen(buffer_.lookupTransform(frame_, feedback->header.frame_id, ros::Time(0)));
    goal_W_ = X_WF * sweep_guard_ros::fromMsg(feedback->pose);
  } catch (const tf2::TransformException& error) {
    ROS_ERROR_THROTTLE(kMarkerReminder, "pose of the marker refused: %s", error.what());
  } catch (const sweep_guard_core::InvalidInput& error) {
    ROS_ERROR_THROTTLE(kMarkerReminder, "pose of the marker refused: %s", error.what());
  }
}

}  // namespace sweep_guard_simulation
