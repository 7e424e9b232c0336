#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <sweep_guard/Warning.h>
#include <tf2_ros/buffer.h>

#include <Eigen/Geometry>
#include <future>
#include <string>
#include <vector>

#include "simulation/guided_tip.h"
#include "simulation/joystick.h"

namespace sweep_guard_simulation {

/// Guides a tip by the messages of an input device on the topic `joy`. When one of its buttons goes down, calls
/// `acknowledge` of the guard whose warnings arrive on the topic `warning`: does not wait for the answer, and does nothing
/// while a call runs.
class JoyGuide {
 public:
  /// @param acknowledge_button  index in the messages of the device; -1: none
  JoyGuide(ros::NodeHandle node, const Joystick::Options& options, int acknowledge_button);

  void move(GuidedTip& tip, double dt) const;

  /// Stops the tool after a stall, until a message arrives that was not waiting during the stall.
  void release();

 private:
  void onWarning(const sweep_guard::Warning::ConstPtr& warning) { warning_ = warning; }
  void onJoy(const sensor_msgs::Joy::ConstPtr& joy);
  void update(const std::vector<int>& buttons);
  bool idle() const;
  void acknowledge();

  Joystick joystick_;
  ros::NodeHandle node_;
  int acknowledge_button_;
  bool down_ = false;  // the button
  ros::Subscriber warning_subscriber_;
  sweep_guard::Warning::ConstPtr warning_;  // newest
  std::future<void> call_;
  ros::Subscriber subscriber_;
};

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
