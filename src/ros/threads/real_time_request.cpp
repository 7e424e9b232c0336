#include "ros/threads/real_time_request.h"

#include <ros/console.h>

#include "ros/process/process.h"

namespace sweep_guard_ros {

void RealTimeRequest::make() {
  setPrompt();
  if (priority_ == 0) return;
  const std::string refusal = requestRealTime(priority_, parameter_);
  if (refusal.empty()) return;
  ROS_WARN("%s", refusal.c_str());
  const sweep_guard_core::Lock lock(mutex_);
  refusal_ = refusal;
}

std::string RealTimeRequest::refusal() const {
  const sweep_guard_core::Lock lock(mutex_);
  return refusal_;
}

}  // namespace sweep_guard_ros
