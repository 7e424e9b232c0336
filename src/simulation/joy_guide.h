#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include "simulation/guided_tip.h"
#include "simulation/joystick.h"

namespace sweep_guard_simulation {

/// Leads a tip by the messages of an input device on the topic `joy`.
class JoyGuide {
 public:
  JoyGuide(ros::NodeHandle node, const Joystick::Options& options);

  void move(GuidedTip& tip, double dt) const;

  /// After a stall: the tool rests until a message comes that has not waited meanwhile.
  void release();

 private:
  void onJoy(const sensor_msgs::Joy::ConstPtr& joy);

  Joystick joystick_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_simulation
