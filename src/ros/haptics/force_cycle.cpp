#include "ros/haptics/force_cycle.h"

#include <boost/make_shared.hpp>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

using sweep_guard_core::DeviceWrench;
using sweep_guard_core::ForceInputs;
using sweep_guard_core::Instant;

ForceCycle::ForceCycle(ros::NodeHandle node, const HapticsParameters& parameters, const ForceCycleSources& sources)
    : parameters_(parameters),
      sources_(sources),
      ticks_(kPeriod),
      renderer_(parameters.force),
      device_(parameters.force, parameters.hand),
      publisher_(node.advertise<geometry_msgs::WrenchStamped>("servo_cf", 1)) {}

void ForceCycle::tick() {
  const sweep_guard_core::Lock lock(mutex_);
  if (stopped_) return;
  const Instant at = now();
  ticks_.tick(at.steady);
  state_.sent = wrenchAt(at);
  publish(state_.sent);
}

void ForceCycle::stop() {
  const sweep_guard_core::Lock lock(mutex_);
  stopped_ = true;
  publish({});
}

ForceCycle::State ForceCycle::state() const {
  const sweep_guard_core::Lock lock(mutex_);
  State state = state_;
  state.energy = device_.energy();
  state.tolerance = device_.tolerance();
  state.turn_energy = device_.turnEnergy();
  state.turn_tolerance = device_.turnTolerance();
  return state;
}

DeviceWrench ForceCycle::wrenchAt(const Instant& at) {
  ForceInputs inputs;
  inputs.known = sources_.guard.inputs();
  inputs.known.pose = sources_.tool.newest();
  const std::optional<Eigen::Matrix3d> R_WD = sources_.axes.newest(at.stamp);
  if (R_WD) {
    inputs.R_WD = *R_WD;
  } else {
    inputs.known.warning.reset();
  }
  observe(inputs, at);
  if (sources_.device != nullptr) {
    const auto device = sources_.device->newest();
    inputs.device = device ? device->timestamps : sweep_guard_core::Timestamps{};
  }
  state_.rendered = renderer_.render(inputs, state_.sent, at);
  return device_.limit(state_.rendered.wrench, at.steady);
}

void ForceCycle::observe(const ForceInputs& inputs, const Instant& at) {
  if (sources_.device != nullptr) {
    if (const auto hand = sources_.device->newest()) {
      device_.observe({hand->X_WT, Eigen::Matrix3d::Identity(), 1.0, hand->timestamps}, at);
    }
  } else if (const auto& tool = inputs.known.pose) {
    device_.observe({tool->X_WT, inputs.R_WD, parameters_.force.position_scale, tool->timestamps}, at);
  }
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
