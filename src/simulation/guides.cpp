#include "simulation/guides.h"

#include <sweep_guard/Acknowledge.h>
#include <tf2_eigen/tf2_eigen.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <utility>

#include "common/rotation_between.h"
#include "simulation/motion_start.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;

namespace {

constexpr double kJoyReminder = 10.0;  // [s]
constexpr sweep_guard_core::Duration kBacklog =
    std::chrono::milliseconds(100);  // time in which roscpp delivers waiting messages

constexpr double kMarkerReminder = 5.0;  // [s]
constexpr float kSize = 0.2F;            // [m] larger than the tool, smaller than the view of rviz

// rviz uses the x axis of the control's orientation.
InteractiveMarkerControl control(const std::string& name, std::uint8_t mode, const Eigen::Vector3d& axis) {
  InteractiveMarkerControl control;
  control.name = name;
  control.interaction_mode = mode;
  control.orientation = tf2::toMsg(sweep_guard_core::rotationBetween(Eigen::Vector3d::UnitX(), axis));
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

using sweep_guard::Acknowledge;

void JoyGuide::update(const std::vector<int>& buttons) {
  const auto index = static_cast<std::size_t>(acknowledge_button_);
  const bool down = acknowledge_button_ >= 0 && index < buttons.size() && buttons[index] != 0;
  const bool pressed = down && !std::exchange(down_, down);
  down_ = down;
  if (pressed && warning_ && !warning_->mesh_id.empty() && idle()) acknowledge();
}

bool JoyGuide::idle() const {
  return !call_.valid() || call_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// The operator means the workpiece that he was warned of, not one that is warned of by the time the call arrives.
void JoyGuide::acknowledge() {
  const std::string guard = ros::names::parentNamespace(warning_subscriber_.getTopic());
  auto client = node_.serviceClient<Acknowledge>(ros::names::append(guard, "acknowledge"));
  Acknowledge acknowledge;
  acknowledge.request.mesh_id = warning_->mesh_id;
  call_ = std::async(std::launch::async, [client, acknowledge]() mutable {
    const bool answered = client.call(acknowledge);
    ROS_INFO("%s: %s", client.getService().c_str(), answered ? acknowledge.response.message.c_str() : "no answer");
  });
}

JoyGuide::JoyGuide(ros::NodeHandle node, const Joystick::Options& options, int acknowledge_button)
    : joystick_(options),
      node_(node),
      acknowledge_button_(acknowledge_button),
      warning_subscriber_(node.subscribe("warning", 1, &JoyGuide::onWarning, this)),
      subscriber_(node.subscribe("joy", 1, &JoyGuide::onJoy, this)) {
  ROS_INFO("guide the tool with the device that publishes %s", subscriber_.getTopic().c_str());
}

void JoyGuide::move(GuidedTip& tip, double dt) const {
  if (subscriber_.getNumPublishers() == 0) {
    ROS_WARN_THROTTLE(kJoyReminder, "the tool rests: nobody publishes %s; start the driver of the device",
                      subscriber_.getTopic().c_str());
  }
  tip.moveAt(joystick_.velocity(rosNow()), dt);
}

void JoyGuide::release() { joystick_.ignoreUntil(rosNow() + kBacklog); }

void JoyGuide::onJoy(const sensor_msgs::Joy::ConstPtr& joy) {
  update(joy->buttons);
  try {
    joystick_.setAxes(joy->axes, rosNow());  // the device may use another clock
  } catch (const sweep_guard_core::InvalidInput& error) {
    ROS_ERROR_THROTTLE(kJoyReminder, "message on %s refused: %s", subscriber_.getTopic().c_str(), error.what());
  }
}

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
