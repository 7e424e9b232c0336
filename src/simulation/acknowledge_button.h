#pragma once

#include <ros/ros.h>
#include <sweep_guard/Warning.h>

#include <future>
#include <string>
#include <vector>

namespace sweep_guard_simulation {

/// Calls `acknowledge` of the guard whose warnings arrive on the topic `warning` when a button of an input device goes
/// down.
class AcknowledgeButton {
 public:
  /// @param button  index in the messages of the device; -1: none
  AcknowledgeButton(ros::NodeHandle node, int button);

  /// Takes the buttons of a message of the device. Does not wait for the guard's answer, and does nothing while a call
  /// runs.
  void update(const std::vector<int>& buttons);

 private:
  void onWarning(const sweep_guard::Warning::ConstPtr& warning) { warning_ = warning; }
  bool idle() const;
  void call();

  ros::NodeHandle node_;
  int button_;
  bool down_ = false;
  ros::Subscriber subscriber_;
  sweep_guard::Warning::ConstPtr warning_;  // newest
  std::future<void> call_;
};

}  // namespace sweep_guard_simulation
