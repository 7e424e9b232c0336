#pragma once

#include <cstdint>
#include <optional>

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

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
  kNoPlanes,       ///< no separating planes have arrived yet
  kPlanesSilent,   ///< no separating planes have arrived within `silence`
  kPlanesExpired,  ///< the separating planes are past their `valid_until`
  kNoPose,         ///< no tool pose has arrived yet
  kPoseSilent,     ///< no tool pose has arrived within `silence`
  kOldPose,        ///< the newest tool pose is older than `pose_age`
  kIncomplete,     ///< not every workpiece was tested at the pose of the separating planes
  kNoTool,         ///< the tool that the separating planes were computed for is not known
  kDeviceSilent    ///< of a haptic device: none of its own poses has arrived within ForceLimits::silence
};

/// Returns the cause in words for people.
const char* textOf(PermissionCause cause);

/// When to let nothing through.
struct PermissionLimits {
  Duration silence = std::chrono::milliseconds(150);           ///< of the guard, by receipt; > 0
  Duration command_timeout = std::chrono::milliseconds(100);   ///< > 0
  double escape_speed = 0.0;                                   ///< of any tool point [m/s], >= 0; 0: no escape
  Duration escape_plane_age = std::chrono::milliseconds(500);  ///< older planes do not show where to escape to; > 0
  Duration pose_age = std::chrono::milliseconds(500);          ///< of the tool's pose, by its stamp; > 0
};

/// What is known when a command is to be passed on.
struct PermissionInputs {
  struct GuardWarning {
    WarningLevel level = WarningLevel::kUnknown;
    std::uint32_t reasons = 0;  ///< bits of Reason
    SteadyTime received;
  };
  struct Planes {
    Timestamps timestamps;   ///< stamp of the pose that they were computed at
    Time valid_until;        ///< by the clock of the stamps
    bool complete = true;    ///< every workpiece was tested at that pose
    bool tool_known = true;  ///< the balls of the tool that they were computed for have arrived
  };
  std::optional<Timestamps> command;    ///< newest one; without a stamp of its own, that of its receipt
  std::optional<GuardWarning> warning;  ///< newest warning
  std::optional<Planes> planes;         ///< newest ones
  std::optional<Timestamps> pose;       ///< newest pose of the tool
};

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
/// | warning, pose or planes silent for `silence`; an old pose, planes past `valid_until`, UNKNOWN | kEscape or kStop |
/// | planes that are incomplete or of an unknown tool | kStop |
/// | otherwise | kLimited |
///
/// Escape needs an `escape_speed`, a warning, a pose and complete planes of a known tool that are not older than
/// `escape_plane_age` on both clocks, and reasons none of which is kNoMesh, kMeshInvalid, kTimeJump, kDetectorFault or
/// kNotSwept: with these, the planes are not those of all surfaces. Silence keeps the reasons of the last warning.
PermissionDecision decidePermission(const PermissionInputs& inputs, const Instant& now, const PermissionLimits& limits);

}  // namespace sweep_guard_core
