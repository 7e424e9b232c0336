#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/haptics/contact_force.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/motion_permission.h"

namespace sweep_guard_core {

/// Options of ForceRenderer.
struct ForceOptions {
  ContactLaw law;
  double position_scale = 1.0;                     ///< displacement of the tool per displacement of the device [-], > 0
  double force_scale = 1.0;                        ///< force at the device per force on the tool [-], > 0
  double max_force = 3.0;                          ///< at the device [N], > 0
  double max_force_rate = 500.0;                   ///< [N/s], > 0
  double max_torque = 0.0;                         ///< at the device [N m], >= 0; 0: no torque
  double max_torque_rate = 20.0;                   ///< [N m/s], > 0
  double device_damping = 2.0;                     ///< of device and hand [N s/m]; above that of the law at the device
  double device_turn_damping = 0.01;               ///< the same about any axis [N m s/rad], > 0
  Duration period = std::chrono::milliseconds(1);  ///< > 0
  Duration output_delay = std::chrono::milliseconds(2);  ///< until what is sent acts, at most; >= 0
  // When a force is withdrawn:
  Duration warning_silence = std::chrono::milliseconds(150);  ///< by receipt, > 0
  Duration silence = std::chrono::milliseconds(50);           ///< of poses and planes, by receipt, > 0
  Duration ramp = std::chrono::milliseconds(20);              ///< in which the force then goes to zero, > 0
  Duration pose_age = std::chrono::milliseconds(150);         ///< by stamp, > 0
};

/// How much of a force is let through, and why.
struct ForcePermission {
  double gain = 0.0;  ///< of the force, in [0, 1]
  PermissionCause cause = PermissionCause::kNoWarning;
};

/// A tool whose pieces joints move apart, at the newest pose of its frame.
struct PlacedByJoints {
  const MovingTool* tool;  ///< not null; must outlive its use
  Timestamps timestamps;   ///< of the joints
};

/// What a force is computed from.
struct ForceInputs {
  std::optional<Timestamps> device;  ///< newest pose that the device tells itself; empty: the tool stands for it
  MotionInputs known;                ///< of the guard, and the newest pose of the tool
  std::optional<PlacedByJoints> placed = {};           ///< where joints put the tool's pieces; empty: it is rigid
  Eigen::Matrix3d R_WD = Eigen::Matrix3d::Identity();  ///< axes of the device in the fixed frame
};

/// Decides how much of a force is let through. Nothing is remembered. The first row that applies wins:
///
/// | inputs | gain |
/// |---|---|
/// | no warning for `warning_silence`, UNKNOWN | 0 |
/// | no pose or no planes yet, an old pose, planes past `valid_until`, incomplete or of an unknown tool | 0 |
/// | planes of a tool that joints move, and it is not known where they put it, or an old place | 0 |
/// | pose, planes, joints or device silent for `silence` | from 1 down to 0 within `ramp` |
/// | otherwise | 1 |
ForcePermission decideForce(const ForceInputs& inputs, const Instant& now, const ForceOptions& options);

/// A device that is sampled and driven with a period, and the damper that is simulated with it.
struct SampledDevice {
  double damping = 2.0;          ///< of the device and the hand that holds it [N s/m], >= 0
  double virtual_damping = 0.0;  ///< that is simulated [N s/m], >= 0
  double period = 0.001;         ///< [s], > 0
};

/// Returns the largest stiffness [N/m] of a simulated wall that such a device can be coupled to without gaining energy from
/// it in a linear model: K < (b - B) / (T/2 + delay), 0 if B >= b. Without delay this is the condition of Colgate and
/// Schenkel (1997), b > K T / 2 + B. With a delay of m periods the term of the spring grows by the maximum 2 m + 1 of
/// Dirichlet's kernel, b > K (T/2 + m T) + B; doc/haptics.md derives it. The denominator is that of Gil et al. (2009).
/// @param delay  from a position of the device to the force that answers to it, without the hold of a period [s], >= 0
double maxStiffness(const SampledDevice& device, double delay);

/// Returns the damping [N s/m] against the motion of a point that a force acts on with a lever about the device, where each
/// force F comes with a torque F * lever: with the dampings b and c of translation and rotation, a spring K and a damper B at that
/// point gain no energy if (K (T/2 + delay) + B) (1/b + lever^2/c) < 1, so 1 / (1/b + lever^2/c) stands for b. For one contact.
/// @param damping       of translation [N s/m], > 0
/// @param turn_damping  of rotation [N m s/rad], > 0
/// @param lever         [m]
double dampingWithLever(double damping, double turn_damping, double lever);

/// Force and torque of a device on the hand, along the axes of its frame D.
struct DeviceWrench {
  Eigen::Vector3d force_D = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque_D = Eigen::Vector3d::Zero();  ///< [N m]
};

/// A force for the device, and what it was scaled by.
struct RenderedForce {
  DeviceWrench wrench;
  ForcePermission permission;
  double depth = 0.0;           ///< of the tool [m]
  double stiffness_gain = 1.0;  ///< share of the stiffness that the delay allows, in [0, 1]
  Duration delay{};             ///< that is assumed: the longest lately, plus that of the output
};

/// Computes the force of the surfaces around the tool for a device, clamped in size and rate. The result may be active:
/// PassiveDevice limits it afterwards. One thread at a time. It allocates nothing.
class ForceRenderer {
 public:
  /// @throws InvalidInput  if an option is NaN or out of range
  explicit ForceRenderer(const ForceOptions& options);

  /// @param sent  what was sent last
  /// @param now   not before that of the last call
  RenderedForce render(const ForceInputs& inputs, const DeviceWrench& sent, const Instant& now);

  const ForceOptions& options() const { return options_; }

 private:
  void measureVelocity(const MotionInputs::ToolPose& pose);
  void measureDelay(const Timestamps& pose, const Instant& now);
  double stiffnessGain(const DeviceWrench& stiff) const;
  DeviceWrench atDevice(const ToolForce& force, const Eigen::Matrix3d& R_WD) const;
  DeviceWrench clamped(const DeviceWrench& wanted, const DeviceWrench& before, double period) const;

  const ForceOptions options_;
  ContactForceFinder finder_;
  std::optional<StampedPose> newest_;  // of the tool
  Twist twist_W_;                      // low-passed
  double delay_ = 0.0;                 // longest lately [s]
  std::optional<SteadyTime> rendered_;
  DeviceWrench unfaded_;  // of the last call, before the gain of the permission
  bool faded_ = false;    // by a gain below 1
};

}  // namespace sweep_guard_core
