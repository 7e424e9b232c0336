#pragma once

#include <ros/node_handle.h>
#include <sweep_guard/MotionStatus.h>

#include <cstdint>
#include <map>
#include <string>

#include "common/guarded_by.h"
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
  void publish() REQUIRES(mutex_);
  void log(const sweep_guard::MotionStatus& before) REQUIRES(mutex_);

  const std::string fixed_frame_;
  mutable sweep_guard_core::Mutex mutex_;
  sweep_guard::MotionStatus newest_ GUARDED_BY(mutex_);
  std::map<std::string, std::uint64_t> counts_ GUARDED_BY(mutex_);
  sweep_guard_core::SteadyTime published_ GUARDED_BY(mutex_);
  sweep_guard_core::SteadyTime logged_ GUARDED_BY(mutex_);
  ros::Publisher status_;
  ros::Publisher servo_status_;
};

}  // namespace sweep_guard_ros
