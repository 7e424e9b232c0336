#include "sweep_guard/haptics/force_permission.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

double fade(Duration silent, const ForceLimits& limits) {
  return std::clamp(1.0 - toSeconds(silent - limits.silence) / toSeconds(limits.ramp), 0.0, 1.0);
}

}  // namespace

ForcePermission decideForce(const ForceEvidence& evidence, const Instant& now, const ForceLimits& limits) {
  const PermissionInputs& inputs = evidence.guard;
  if (!inputs.warning) return {0.0, PermissionCause::kNoWarning};
  if (now.steady - inputs.warning->received > limits.warning_silence) return {0.0, PermissionCause::kWarningSilent};
  if (inputs.warning->level == WarningLevel::kUnknown) return {0.0, PermissionCause::kUnknown};
  if (!inputs.pose) return {0.0, PermissionCause::kNoPose};
  if (now.stamp - inputs.pose->stamp > limits.pose_age) return {0.0, PermissionCause::kOldPose};
  if (!inputs.planes) return {0.0, PermissionCause::kNoPlanes};
  if (now.stamp > inputs.planes->valid_until) return {0.0, PermissionCause::kPlanesExpired};
  if (!inputs.planes->complete) return {0.0, PermissionCause::kIncomplete};
  if (!inputs.planes->tool_known) return {0.0, PermissionCause::kNoTool};

  ForcePermission permission{1.0, PermissionCause::kGuarded};
  const auto fadeWith = [&](const Timestamps& input, PermissionCause cause) {
    const double gain = fade(now.steady - input.received, limits);
    if (gain < permission.gain) permission = {gain, cause};
  };
  fadeWith(*inputs.pose, PermissionCause::kPoseSilent);
  fadeWith(inputs.planes->timestamps, PermissionCause::kPlanesSilent);
  if (evidence.device) fadeWith(*evidence.device, PermissionCause::kDeviceSilent);
  return permission;
}

}  // namespace sweep_guard_core
