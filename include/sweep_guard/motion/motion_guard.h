#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/motion_in_flight.h"
#include "sweep_guard/motion/motion_permission.h"
#include "sweep_guard/motion/velocity_limiter.h"

namespace sweep_guard_core {

/// A commanded velocity of one point of the tool.
struct MotionCommand {
  Twist twist_W;                                      ///< of the point
  Eigen::Vector3d point_T = Eigen::Vector3d::Zero();  ///< fixed to the tool [m]
  Timestamps timestamps;                              ///< without a stamp of its own, that of its receipt
  Duration period{};                                  ///< until the next command, > 0
  /// Pose of the tool at which the robot comes to rest without this command, if that is known: of a robot that follows
  /// poses, the newest one sent. Otherwise it is expected from the velocities that were sent.
  std::optional<Eigen::Isometry3d> rest_WT;
};

/// What is sent in place of a command, and why.
struct GuardedMotion {
  /// The plane that limits a command.
  struct Limiting {
    size_t plane;              ///< index into PlaneSet::planes
    Eigen::Vector3d normal_W;  ///< of the plane: unit, from the surface to the tool
    double gap;                ///< of the ball that is limited, at the newest pose or where it is expected [m]
    double closing_limit;      ///< largest closing speed that is allowed [m/s], >= 0
  };
  Twist twist_W;  ///< of the point of the command; bit for bit the command's if nothing limits it
  PermissionDecision decision;
  double scale = 0.0;            ///< speed of the fastest tool point / that of the command, in [0, 1]; at rest 1
  double commanded_speed = 0.0;  ///< of the fastest tool point [m/s]; NaN: joints move, and where it is is not known
  double sent_speed = 0.0;       ///< of the fastest tool point [m/s]
  std::optional<Limiting> limiting;  ///< plane that the command closes on most above its limit; empty: none does
  Duration planes_age{};             ///< on the clock on which it is larger; 0 without planes
};

/// Limits commanded velocities of a tool so that it can stop before the surfaces around it, and stops it when the guard
/// does not know. One thread at a time. After the first calls it allocates nothing.
class MotionGuard {
 public:
  /// @throws InvalidInput  if an option is NaN or out of range
  explicit MotionGuard(const MotionGuardOptions& options);

  /// Returns what to send for a command, and remembers that it was sent.
  /// @param now  not before that of the last call
  /// @throws InvalidInput  if the command is not finite or out of range; then stop() has to be sent
  GuardedMotion guard(const MotionInputs& inputs, const MotionCommand& command, const Instant& now);

  /// Decides how much of a command is let through, as guard() does, and remembers nothing: as decidePermission(), but nothing
  /// before planes of a tool that joints move.
  /// @param command  without a stamp of its own, that of its receipt
  PermissionDecision permission(const MotionInputs& inputs, const Timestamps& command, const Instant& now) const;

  /// Remembers that zero was sent.
  void stop(SteadyTime now);

  const MotionGuardOptions& options() const { return options_; }

 private:
  void limit(const MotionInputs& inputs, const MotionCommand& command, const Instant& now, GuardedMotion& motion);
  Eigen::Isometry3d expectedPose(const MotionInputs& inputs, const MotionCommand& command, const Instant& now) const;
  BrakingLimits brakingLimits(const MotionInputs& inputs, const MotionCommand& command, const Instant& now) const;
  void collectFacing(const MotionInputs& inputs, const MotionCommand& command, const Eigen::Isometry3d& X_WT);
  std::optional<GuardedMotion::Limiting> limiting(const Twist& command_W, const BrakingLimits& limits) const;

  const MotionGuardOptions options_;
  VelocityLimiter limiter_;
  MotionInFlight in_flight_;
  std::vector<FacingBall> facing_;  // seen from the point of the command
  std::vector<size_t> plane_of_;    // of each facing ball
};

}  // namespace sweep_guard_core
