#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include "simulation/acknowledge_button.h"
#include "simulation/guided_tip.h"
#include "simulation/joystick.h"

namespace sweep_guard_simulation {

/// Guides a tip by the messages of an input device on the topic `joy`, and acknowledges warnings by one of its buttons.
class JoyGuide {
 public:
  /// @param acknowledge_button  index in the messages of the device; -1: none
  JoyGuide(ros::NodeHandle node, const Joystick::Options& options, int acknowledge_button);

  void move(GuidedTip& tip, double dt) const;

  /// Stops the tool after a stall, until a message arrives that was not waiting during the stall.
  void release();

 private:
  void onJoy(const sensor_msgs::Joy::ConstPtr& joy);

  Joystick joystick_;
  AcknowledgeButton acknowledge_button_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_simulation
