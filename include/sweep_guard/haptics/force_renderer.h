#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "sweep_guard/haptics/contact_force.h"
#include "sweep_guard/haptics/force_permission.h"
#include "sweep_guard/haptics/stiffness_bound.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_core {

/// What a device exerts on its hand, along the axes of its frame D.
struct DeviceWrench {
  Eigen::Vector3d force_D = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque_D = Eigen::Vector3d::Zero();  ///< [N m]
};

struct ForceOptions {
  ContactLaw law;
  double position_scale = 1.0;                     ///< way of the tool for a way of the device [-], > 0
  double force_scale = 1.0;                        ///< force at the device for a force on the tool [-], > 0
  double max_force = 3.0;                          ///< at the device [N], > 0
  double max_force_rate = 500.0;                   ///< [N/s], > 0
  double max_torque = 0.0;                         ///< at the device [N m], >= 0; 0: no torque
  double max_torque_rate = 20.0;                   ///< [N m/s], > 0
  double device_damping = 2.0;                     ///< of device and hand [N s/m]; above that of the law at the device
  double device_turn_damping = 0.01;               ///< the same about any axis [N m s/rad], > 0
  Duration period = std::chrono::milliseconds(1);  ///< > 0
  Duration output_delay = std::chrono::milliseconds(2);  ///< until what is sent acts, at most; >= 0
  ForceLimits limits;
};

/// What a force is computed from.
struct ForceInputs {
  std::optional<Timestamps> device;                    ///< newest pose of the device, if it tells its own
  MotionInputs known;                                  ///< of the guard, and the newest pose of the tool
  Eigen::Matrix3d R_WD = Eigen::Matrix3d::Identity();  ///< axes of the device in the fixed frame
};

struct RenderedForce {
  DeviceWrench wrench;
  ForcePermission permission;
  double depth = 0.0;           ///< of the tool [m]
  double stiffness_gain = 1.0;  ///< share of the stiffness that the delay allows, in [0, 1]
  Duration delay{};             ///< that is counted on: the longest lately, and the output's
};

/// Computes the force of the surfaces around the tool for a device, clamped in size and rate. What it returns may be active:
/// PassiveDevice follows. One thread at a time. It allocates nothing.
class ForceRenderer {
 public:
  /// @throws InvalidInput  if an option is NaN or out of range
  explicit ForceRenderer(const ForceOptions& options);

  /// @param sent  what was sent last
  /// @param now   not before that of the last call
  RenderedForce render(const ForceInputs& inputs, const DeviceWrench& sent, const Instant& now);

  const ForceOptions& options() const { return options_; }

 private:
  struct Sample {
    Eigen::Isometry3d X_WT;
    Time stamp;
  };

  void measureVelocity(const MotionInputs::ToolPose& pose);
  void measureDelay(const Timestamps& pose, const Instant& now);
  double stiffnessGain(const DeviceWrench& stiff) const;
  DeviceWrench atDevice(const ToolForce& force, const Eigen::Matrix3d& R_WD) const;
  DeviceWrench clamped(const DeviceWrench& wanted, const DeviceWrench& before, double period) const;

  const ForceOptions options_;
  ContactForceFinder finder_;
  std::optional<Sample> newest_;  // pose of the tool
  Twist twist_W_;                 // low-passed
  double delay_ = 0.0;            // longest lately [s]
  std::optional<SteadyTime> rendered_;
  DeviceWrench unfaded_;  // of the last call, before the gain of the permission
  bool faded_ = false;    // by a gain below 1
};

}  // namespace sweep_guard_core
