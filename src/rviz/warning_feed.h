#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <mutex>
#include <string>
#include <vector>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Receives warnings on a thread of its own: however busy rviz is, each is as old as it says.
class WarningFeed {
 public:
  WarningFeed();
  ~WarningFeed();
  WarningFeed(const WarningFeed&) = delete;
  WarningFeed& operator=(const WarningFeed&) = delete;

  /// Instead of the topic before; what came from that is forgotten. Empty: none.
  /// @throws ros::InvalidNameException if it is no name of a topic
  void listen(const std::string& topic);

  std::vector<ReceivedWarning> take();  ///< those that came since it was last called, in their order

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
