#include "ros/motion/hold_publisher.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

namespace sweep_guard_ros {
namespace {

constexpr auto kTimeToHear = std::chrono::milliseconds(20);

}  // namespace

HoldPublisher::HoldPublisher(ros::NodeHandle private_node)
    : velocity_scale_(private_node.advertise<std_msgs::Float64>("velocity_scale", 1)),
      lock_(private_node.advertise<std_msgs::Bool>("lock", 1)) {}

void HoldPublisher::publish(bool lets_through, sweep_guard_core::SteadyTime now) {
  std_msgs::Float64 scale;
  scale.data = lets_through ? 1.0 : 0.0;
  velocity_scale_.publish(scale);
  std_msgs::Bool lock;
  lock.data = !lets_through;
  lock_.publish(lock);
  if (!lets_through) released_since_ = kHeld;
  if (lets_through && released_since_.load() == kHeld) released_since_ = now;
}

bool HoldPublisher::released(sweep_guard_core::SteadyTime now) const {
  const sweep_guard_core::SteadyTime since = released_since_;
  return since != kHeld && now - since >= kTimeToHear;
}

}  // namespace sweep_guard_ros
