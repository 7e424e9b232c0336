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
  if (lets_through != lets_through_) changed_ = now;
  lets_through_ = lets_through;
  send(!lets_through && (!changed_ || now - *changed_ >= kTimeToHear));
}

void HoldPublisher::hold() {
  lets_through_ = false;
  send(/*holds=*/true);
}

void HoldPublisher::send(bool holds) {
  std_msgs::Float64 scale;
  scale.data = holds ? 0.0 : 1.0;
  velocity_scale_.publish(scale);
  std_msgs::Bool lock;
  lock.data = holds;
  lock_.publish(lock);
}

}  // namespace sweep_guard_ros
