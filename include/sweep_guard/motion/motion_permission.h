#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"
#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/motion/plane_set.h"

namespace sweep_guard_core {

/// How much of a command is let through.
enum class Permission : std::uint8_t {
  kStop,    ///< zero
  kEscape,  ///< escapeVelocity()
  kLimited  ///< VelocityLimiter::limit()
};

/// Why it is this much.
enum class PermissionCause : std::uint8_t {
  kGuarded,        ///< warning, planes and command are fresh
  kNoCommand,      ///< no command has arrived yet
  kOldCommand,     ///< the newest command is older than `command_timeout`
  kNoWarning,      ///< no warning has arrived yet
  kWarningSilent,  ///< no warning has arrived within `silence`
  kUnknown,        ///< the level of the warning is UNKNOWN
  kUnseen,         ///< hardly any of the predicted path is seen by a camera
  kNoPlanes,       ///< no separating planes have arrived yet
  kPlanesSilent,   ///< no separating planes have arrived within `silence`
  kPlanesExpired,  ///< the separating planes are past their `valid_until`
  kNoPose,         ///< no tool pose has arrived yet
  kPoseSilent,     ///< no tool pose has arrived within `silence`
  kOldPose,        ///< the newest tool pose is older than `pose_age`
  kNoJoints,       ///< no joint positions have arrived yet
  kJointsSilent,   ///< no joint positions have arrived within `silence`
  kOldJoints,      ///< the newest joint positions are older than `pose_age`
  kOtherJoints,    ///< the separating planes are of a rigid tool, or of a robot with other joints or links
  kIncomplete,     ///< not every workpiece was tested at the pose of the separating planes
  kNoTool,         ///< the tool that the separating planes were computed for is not known
  kMovingJoints,   ///< joints move the guard's tool, and none are known here that place it
  kDeviceSilent    ///< of a haptic device: none of its own poses has arrived within ForceOptions::silence
};

/// Returns the cause in words for people.
const char* textOf(PermissionCause cause);

/// Options of MotionGuard and JointMotionGuard.
struct MotionGuardOptions {
  double deceleration = 1.0;  ///< of the fastest tool point when the robot is stopped, along its path [m/s^2], > 0
  double standoff = 0.002;    ///< distance from a plane at which the closing speed is 0 [m], >= 0
  Duration dead_time{};       ///< until the robot begins to do what was sent, >= 0
  Duration time_constant{};   ///< of the first-order lag with which the robot follows, >= 0
  // When to let nothing through:
  Duration silence = std::chrono::milliseconds(150);          ///< of the guard, by receipt; > 0
  Duration command_timeout = std::chrono::milliseconds(100);  ///< > 0
  double escape_speed = 0.0;                                  ///< of any tool point [m/s], >= 0; 0: no escape
  double unseen_speed = 0.05;  ///< largest of any tool point where no camera sees it going [m/s], >= 0
  Duration escape_plane_age = std::chrono::milliseconds(500);  ///< older planes do not show where to escape to; > 0
  Duration pose_age = std::chrono::milliseconds(500);          ///< of the tool's pose or joints, by its stamp; > 0

  /// Returns how long the robot goes on after the last command.
  Duration settlingTime() const { return dead_time + 2 * time_constant; }
  /// Returns what the robot can do with inputs of an age and commands of a period, for a tool without a radius.
  BrakingLimits brakingLimits(Duration period, Duration age_of_inputs) const;
};

/// @throws InvalidInput  if an option is NaN or out of range
void requireUsable(const MotionGuardOptions& options);

/// What is known when a command is to be passed on, apart from the command. Null or empty: nothing has arrived yet.
struct MotionInputs {
  /// Pose of the tool frame.
  struct ToolPose {
    Eigen::Isometry3d X_WT;
    Timestamps timestamps;
  };
  /// What counts of a warning of the guard.
  struct GuardWarning {
    WarningLevel level = WarningLevel::kUnknown;
    std::uint32_t reasons = 0;  ///< bits of Reason
    SteadyTime received;

    bool sees() const { return (reasons & kNotSeen) == 0; }  ///< where the tool is going, or there is no camera
    /// Returns whether the guard knows all that it can see.
    bool knows() const { return level != WarningLevel::kUnknown || (!sees() && (reasons & ~kNotStopping) == 0); }
  };
  std::shared_ptr<const PlaneSet> planes;  ///< newest ones
  std::shared_ptr<const ToolBalls> tool;   ///< newest one
  std::optional<ToolPose> pose;            ///< newest one
  std::optional<GuardWarning> warning;     ///< newest one

  bool jointsMoveTool() const { return planes && !planes->joints.empty(); }
  bool toolIsKnown() const { return tool && belongsTo(*planes, *tool); }  ///< that the planes were computed for
};

/// How much of a command is let through, and why.
struct PermissionDecision {
  Permission permission = Permission::kStop;
  PermissionCause cause = PermissionCause::kNoCommand;
};

/// Decides how much of a command is let through. Nothing is remembered: the same inputs give the same decision. The
/// first row that applies wins:
///
/// | inputs | permission |
/// |---|---|
/// | no command, or one older than `command_timeout` | kStop |
/// | warning, pose or planes silent for `silence`; an old pose, planes past `valid_until`, UNKNOWN not by NOT_SEEN alone | kEscape or kStop |
/// | planes that are incomplete or of an unknown tool | kStop |
/// | otherwise | kLimited, with NOT_SEEN to `unseen_speed` |
///
/// Escape needs an `escape_speed`, a warning, a pose and complete planes of a known tool, both not older than
/// `escape_plane_age` on either clock, and no reason of kSurfacesMissing: with one of these, the planes are not those of
/// all surfaces. While the guard is silent, the reasons of its last warning count.
/// @param command  newest one; without a stamp of its own, that of its receipt
PermissionDecision decidePermission(const MotionInputs& inputs, const std::optional<Timestamps>& command,
                                    const Instant& now, const MotionGuardOptions& options);

}  // namespace sweep_guard_core
