#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "ros/haptics/haptics_parameters.h"
#include "ros/haptics/tick_record.h"

namespace sweep_guard_ros {

/// Computes the force of the surfaces at each tick and publishes it on `servo_cf`: zero where nothing is known. Outside
/// roscpp, a tick waits for no thread without its priority and allocates nothing, except a message while a nodelet
/// still keeps the previous one.
class ForceCycle {
 public:
  static constexpr sweep_guard_core::Duration kPeriod = std::chrono::milliseconds(1);

  /// @throws sweep_guard_core::InvalidInput if the parameters do not fit together
  ForceCycle(ros::NodeHandle node, const HapticsParameters& parameters);

  /// To be called each kPeriod.
  /// @param hand  what moves the device; empty: it is not known
  void tick(const sweep_guard_core::ForceInputs& inputs,
            const std::optional<sweep_guard_core::PassiveDevice::Hand>& hand, const sweep_guard_core::Instant& at);
  void stop();  ///< publishes zero, and nothing after it

  struct State {
    sweep_guard_core::RenderedForce rendered;
    sweep_guard_core::DeviceWrench sent;
    double energy = 0.0;          ///< that an axis of translation of the device gave at most [J]
    double tolerance = 0.0;       ///< [J]
    double turn_energy = 0.0;     ///< that an axis of rotation gave at most [J]
    double turn_tolerance = 0.0;  ///< [J]; 0: there is no torque
  };
  State state() const;
  const TickRecord& ticks() const { return ticks_; }
  std::string topic() const { return publisher_.getTopic(); }
  std::uint32_t subscribers() const { return publisher_.getNumSubscribers(); }

 private:
  void publish(const sweep_guard_core::DeviceWrench& wrench) REQUIRES(mutex_);

  const HapticsParameters& parameters_;
  TickRecord ticks_;
  mutable sweep_guard_core::Mutex mutex_;  // of what follows
  sweep_guard_core::ForceRenderer renderer_ GUARDED_BY(mutex_);
  sweep_guard_core::PassiveDevice device_ GUARDED_BY(mutex_);
  State state_ GUARDED_BY(mutex_);
  bool stopped_ GUARDED_BY(mutex_) = false;
  boost::shared_ptr<geometry_msgs::WrenchStamped> message_ GUARDED_BY(mutex_);  // null, or what was published last
  ros::Publisher publisher_;
};

}  // namespace sweep_guard_ros
