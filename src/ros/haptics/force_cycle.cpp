#include "ros/haptics/force_cycle.h"

#include <boost/make_shared.hpp>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

using sweep_guard_core::DeviceWrench;
using sweep_guard_core::ForceInputs;
using sweep_guard_core::Instant;

ForceCycle::ForceCycle(ros::NodeHandle node, const HapticsParameters& parameters)
    : parameters_(parameters),
      ticks_(kPeriod),
      renderer_(parameters.force),
      device_(parameters.force, parameters.hand),
      publisher_(node.advertise<geometry_msgs::WrenchStamped>("servo_cf", 1)) {}

void ForceCycle::tick(const ForceInputs& inputs, const std::optional<sweep_guard_core::PassiveDevice::Hand>& hand,
                      const Instant& at) {
  const sweep_guard_core::Lock lock(mutex_);
  if (stopped_) return;
  ticks_.tick(at.steady);
  if (hand) device_.observe(*hand, at);
  state_.rendered = renderer_.render(inputs, state_.sent, at);
  state_.sent = device_.limit(state_.rendered.wrench, at.steady);
  publish(state_.sent);
}

void ForceCycle::stop() {
  const sweep_guard_core::Lock lock(mutex_);
  stopped_ = true;
  publish({});
}

ForceCycle::State ForceCycle::state() const {
  const sweep_guard_core::Lock lock(mutex_);
  return {state_.rendered,     state_.sent,          device_.energy(),
          device_.tolerance(), device_.turnEnergy(), device_.turnTolerance()};
}

void ForceCycle::publish(const DeviceWrench& wrench) {
  if (!message_.unique()) message_ = boost::make_shared<geometry_msgs::WrenchStamped>();  // a nodelet keeps it
  message_->header.frame_id = parameters_.device_frame;
  message_->header.stamp = ros::Time::now();
  message_->wrench.force = vectorMsg<geometry_msgs::Vector3>(wrench.force_D);
  message_->wrench.torque = vectorMsg<geometry_msgs::Vector3>(wrench.torque_D);
  publisher_.publish(message_);
}

}  // namespace sweep_guard_ros
