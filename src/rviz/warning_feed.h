#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <mutex>
#include <string>
#include <vector>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Receives warnings on a thread of its own, so that a busy rviz does not delay their time of arrival.
class WarningFeed {
 public:
  WarningFeed();
  ~WarningFeed();
  WarningFeed(const WarningFeed&) = delete;
  WarningFeed& operator=(const WarningFeed&) = delete;

  /// Switches to another topic and drops the warnings of the previous one. An empty topic ends listening.
  /// @throws ros::InvalidNameException if `topic` is not a valid name
  void listen(const std::string& topic);

  std::vector<ReceivedWarning> take();  ///< warnings received since the last call, in order

 private:
  void receive(const sweep_guard::Warning& warning);

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber subscriber_;
  std::mutex mutex_;
  std::vector<ReceivedWarning> received_;
};

}  // namespace sweep_guard_rviz
