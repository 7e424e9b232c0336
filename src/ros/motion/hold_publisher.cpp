#include "ros/motion/hold_publisher.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

namespace sweep_guard_ros {

HoldPublisher::HoldPublisher(ros::NodeHandle private_node)
    : velocity_scale_(private_node.advertise<std_msgs::Float64>("velocity_scale", 1)),
      lock_(private_node.advertise<std_msgs::Bool>("lock", 1)) {}

void HoldPublisher::publish(bool lets_through) {
  std_msgs::Float64 scale;
  scale.data = lets_through ? 1.0 : 0.0;
  velocity_scale_.publish(scale);
  std_msgs::Bool lock;
  lock.data = !lets_through;
  lock_.publish(lock);
}

}  // namespace sweep_guard_ros
