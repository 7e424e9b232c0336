#include "sweep_guard/haptics/force_permission.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

double fade(Duration silent, const ForceLimits& limits) {
  return std::clamp(1.0 - toSeconds(silent - limits.silence) / toSeconds(limits.ramp), 0.0, 1.0);
}

}  // namespace

ForcePermission decideForce(const PermissionInputs& inputs, const Instant& now, const ForceLimits& limits) {
  if (!inputs.warning) return {0.0, PermissionCause::kNoWarning};
  if (now.steady - inputs.warning->received > limits.warning_silence) return {0.0, PermissionCause::kWarningSilent};
  if (inputs.warning->level == WarningLevel::kUnknown) return {0.0, PermissionCause::kUnknown};
  if (!inputs.pose) return {0.0, PermissionCause::kNoPose};
  if (now.stamp - inputs.pose->stamp > limits.pose_age) return {0.0, PermissionCause::kOldPose};
  if (!inputs.planes) return {0.0, PermissionCause::kNoPlanes};
  if (now.stamp > inputs.planes->valid_until) return {0.0, PermissionCause::kPlanesExpired};
  if (!inputs.planes->complete) return {0.0, PermissionCause::kIncomplete};
  if (!inputs.planes->tool_known) return {0.0, PermissionCause::kNoTool};

  const double pose_gain = fade(now.steady - inputs.pose->received, limits);
  const double planes_gain = fade(now.steady - inputs.planes->timestamps.received, limits);
  if (pose_gain < 1.0 && pose_gain <= planes_gain) return {pose_gain, PermissionCause::kPoseSilent};
  if (planes_gain < 1.0) return {planes_gain, PermissionCause::kPlanesSilent};
  return {1.0, PermissionCause::kGuarded};
}

}  // namespace sweep_guard_core
