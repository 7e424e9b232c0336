#include "sweep_guard/motion/motion_permission.h"

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

std::optional<PermissionCause> problemOfGuard(const MotionInputs& inputs, const Instant& now,
                                              const MotionGuardOptions& options) {
  if (!inputs.warning) return PermissionCause::kNoWarning;
  if (now.steady - inputs.warning->received > options.silence) return PermissionCause::kWarningSilent;
  if (!inputs.warning->knows()) return PermissionCause::kUnknown;
  if (!inputs.pose) return PermissionCause::kNoPose;
  if (now.steady - inputs.pose->timestamps.received > options.silence) return PermissionCause::kPoseSilent;
  if (now.stamp - inputs.pose->timestamps.stamp > options.pose_age) return PermissionCause::kOldPose;
  if (!inputs.planes) return PermissionCause::kNoPlanes;
  if (now.steady - inputs.planes->timestamps.received > options.silence) return PermissionCause::kPlanesSilent;
  if (now.stamp > inputs.planes->valid_until) return PermissionCause::kPlanesExpired;
  if (!inputs.planes->complete) return PermissionCause::kIncomplete;
  if (!inputs.toolIsKnown()) return PermissionCause::kNoTool;
  return {};
}

bool mayEscape(const MotionInputs& inputs, const Instant& now, const MotionGuardOptions& options) {
  if (!(options.escape_speed > 0.0) || !inputs.warning || !inputs.planes || !inputs.pose) return false;
  if (!inputs.planes->complete || !inputs.toolIsKnown()) return false;
  return (inputs.warning->reasons & kSurfacesMissing) == 0 &&
         !stale(inputs.planes->timestamps, now, options.escape_plane_age) &&
         !stale(inputs.pose->timestamps, now, options.escape_plane_age);
}

}  // namespace

BrakingLimits MotionGuardOptions::brakingLimits(Duration period, Duration age_of_inputs) const {
  const Duration reaction = period + age_of_inputs + dead_time + time_constant;
  return {deceleration, std::max(toSeconds(reaction), 1e-3), standoff, 0.0};
}

void requireUsable(const MotionGuardOptions& options) {
  requireUsable(options.brakingLimits({}, {}));
  if (options.dead_time < Duration::zero() || options.time_constant < Duration::zero()) {
    throw InvalidInput("lag of the robot: must be >= 0 s");
  }
  if (!(options.escape_speed >= 0.0)) throw InvalidInput("escape speed: must be >= 0 m/s");
  if (!(options.unseen_speed >= 0.0)) throw InvalidInput("unseen speed: must be >= 0 m/s");
}

const char* textOf(PermissionCause cause) {
  switch (cause) {
    case PermissionCause::kGuarded:
      return "guarded";
    case PermissionCause::kNoCommand:
      return "no command yet";
    case PermissionCause::kOldCommand:
      return "the newest command is too old";
    case PermissionCause::kNoWarning:
      return "no warning yet: does the guard run?";
    case PermissionCause::kWarningSilent:
      return "the guard is silent";
    case PermissionCause::kUnknown:
      return "the guard's level is UNKNOWN";
    case PermissionCause::kUnseen:
      return "no camera sees where the tool is going";
    case PermissionCause::kNoPlanes:
      return "no separating planes yet";
    case PermissionCause::kPlanesSilent:
      return "no new separating planes";
    case PermissionCause::kPlanesExpired:
      return "the separating planes have expired";
    case PermissionCause::kNoPose:
      return "no tool pose yet";
    case PermissionCause::kPoseSilent:
      return "no new tool pose";
    case PermissionCause::kOldPose:
      return "the newest tool pose is too old";
    case PermissionCause::kNoJoints:
      return "no joint positions yet";
    case PermissionCause::kJointsSilent:
      return "no new joint positions";
    case PermissionCause::kOldJoints:
      return "the newest joint positions are too old";
    case PermissionCause::kOtherJoints:
      return "the separating planes are not of this robot: do its joints move the guard's tool?";
    case PermissionCause::kIncomplete:
      return "not every workpiece was tested at the newest pose";
    case PermissionCause::kNoTool:
      return "the balls of this tool have not arrived";
    case PermissionCause::kMovingJoints:
      return "joints move the guard's tool: it needs commands of joints";
    case PermissionCause::kDeviceSilent:
      return "no new pose of the device";
  }
  return "";
}

PermissionDecision decidePermission(const MotionInputs& inputs, const std::optional<Timestamps>& command,
                                    const Instant& now, const MotionGuardOptions& options) {
  if (!command) return {Permission::kStop, PermissionCause::kNoCommand};
  if (stale(*command, now, options.command_timeout)) return {Permission::kStop, PermissionCause::kOldCommand};
  if (const auto problem = problemOfGuard(inputs, now, options)) {
    return {mayEscape(inputs, now, options) ? Permission::kEscape : Permission::kStop, *problem};
  }
  return {Permission::kLimited, inputs.warning->sees() ? PermissionCause::kGuarded : PermissionCause::kUnseen};
}

}  // namespace sweep_guard_core
