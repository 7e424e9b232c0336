#include "simulation/joy_guide.h"

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {

namespace {

constexpr double kReminderPeriod = 10.0;  // [s]
constexpr sweep_guard_core::Duration kBacklog =
    std::chrono::milliseconds(100);  // time in which roscpp delivers waiting messages

// Time of arrival: the device may use another clock.
sweep_guard_core::Time now() { return sweep_guard_ros::fromMsg(ros::Time::now()); }

}  // namespace

JoyGuide::JoyGuide(ros::NodeHandle node, const Joystick::Options& options, int acknowledge_button)
    : joystick_(options),
      acknowledge_button_(node, acknowledge_button),
      subscriber_(node.subscribe("joy", 1, &JoyGuide::onJoy, this)) {
  ROS_INFO("guide the tool with the device that publishes %s", subscriber_.getTopic().c_str());
}

void JoyGuide::move(GuidedTip& tip, double dt) const {
  if (subscriber_.getNumPublishers() == 0) {
    ROS_WARN_THROTTLE(kReminderPeriod, "the tool rests: nobody publishes %s; start the driver of the device",
                      subscriber_.getTopic().c_str());
  }
  tip.moveAt(joystick_.velocity(now()), dt);
}

void JoyGuide::release() { joystick_.ignoreUntil(now() + kBacklog); }

void JoyGuide::onJoy(const sensor_msgs::Joy::ConstPtr& joy) {
  acknowledge_button_.update(joy->buttons);
  try {
    joystick_.setAxes(joy->axes, now());
  } catch (const sweep_guard_core::InvalidInput& error) {
    ROS_ERROR_THROTTLE(kReminderPeriod, "message on %s refused: %s", subscriber_.getTopic().c_str(), error.what());
  }
}

}  // namespace sweep_guard_simulation
