#include "simulation/joy_guide.h"

#include <sweep_guard/Acknowledge.h>

#include <chrono>
#include <cstddef>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kJoyReminder = 10.0;  // [s]
constexpr sweep_guard_core::Duration kBacklog =
    std::chrono::milliseconds(100);  // time in which roscpp delivers waiting messages

// Time of arrival: the device may use another clock.
sweep_guard_core::Time now() { return sweep_guard_ros::fromMsg(ros::Time::now()); }

}  // namespace

using sweep_guard::Acknowledge;

AcknowledgeButton::AcknowledgeButton(ros::NodeHandle node, int button)
    : node_(node), button_(button), subscriber_(node.subscribe("warning", 1, &AcknowledgeButton::onWarning, this)) {}

void AcknowledgeButton::update(const std::vector<int>& buttons) {
  const auto index = static_cast<std::size_t>(button_);
  const bool down = button_ >= 0 && index < buttons.size() && buttons[index] != 0;
  const bool pressed = down && !std::exchange(down_, down);
  down_ = down;
  if (pressed && warning_ && !warning_->mesh_id.empty() && idle()) call();
}

bool AcknowledgeButton::idle() const {
  return !call_.valid() || call_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// The operator means the workpiece that he was warned of, not one that is warned of by the time the call arrives.
void AcknowledgeButton::call() {
  const std::string guard = ros::names::parentNamespace(subscriber_.getTopic());
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
      acknowledge_button_(node, acknowledge_button),
      subscriber_(node.subscribe("joy", 1, &JoyGuide::onJoy, this)) {
  ROS_INFO("guide the tool with the device that publishes %s", subscriber_.getTopic().c_str());
}

void JoyGuide::move(GuidedTip& tip, double dt) const {
  if (subscriber_.getNumPublishers() == 0) {
    ROS_WARN_THROTTLE(kJoyReminder, "the tool rests: nobody publishes %s; start the driver of the device",
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
    ROS_ERROR_THROTTLE(kJoyReminder, "message on %s refused: %s", subscriber_.getTopic().c_str(), error.what());
  }
}

}  // namespace sweep_guard_simulation
