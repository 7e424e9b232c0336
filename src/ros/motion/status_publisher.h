#pragma once

#include <ros/node_handle.h>
#include <sweep_guard/MotionStatus.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "sweep_guard/common/priority_mutex.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Publishes `~status` and `~servo_status` on change and periodically, counts the causes, and logs when the cause changes.
/// Any thread.
class StatusPublisher {
 public:
  StatusPublisher(ros::NodeHandle private_node, std::string fixed_frame);

  void update(sweep_guard::MotionStatus status);
  void publishIfDue();  ///< to be called more often than 10 times a second

  sweep_guard::MotionStatus newest() const;
  std::map<std::string, std::uint64_t> counts() const;  ///< how often each cause began

 private:
  void publish();
  void log(const sweep_guard::MotionStatus& before);

  const std::string fixed_frame_;
  mutable sweep_guard_core::PriorityMutex mutex_;
  sweep_guard::MotionStatus newest_;
  std::map<std::string, std::uint64_t> counts_;
  sweep_guard_core::SteadyTime published_;
  sweep_guard_core::SteadyTime logged_;
  ros::Publisher status_;
  ros::Publisher servo_status_;
};

}  // namespace sweep_guard_ros
