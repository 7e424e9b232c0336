#pragma once

#include "sweep_guard/motion/motion_permission.h"

namespace sweep_guard_core {

/// When a force is taken back.
struct ForceLimits {
  Duration warning_silence = std::chrono::milliseconds(150);  ///< by receipt, > 0
  Duration silence = std::chrono::milliseconds(50);           ///< of poses and planes, by receipt, > 0
  Duration ramp = std::chrono::milliseconds(20);              ///< in which the force then goes to zero, > 0
  Duration pose_age = std::chrono::milliseconds(150);         ///< by stamp, > 0
};

/// What is known when a force is to be sent.
struct ForceEvidence {
  PermissionInputs guard;            ///< but for PermissionInputs::command
  std::optional<Timestamps> device;  ///< newest pose that the device tells itself; empty: the tool stands for it
};

struct ForcePermission {
  double gain = 0.0;  ///< of the force, in [0, 1]
  PermissionCause cause = PermissionCause::kNoWarning;
};

/// Decides how much of a force is let through. Nothing is remembered. The first row that applies wins:
///
/// | inputs | gain |
/// |---|---|
/// | no warning for `warning_silence`, UNKNOWN | 0 |
/// | no pose or no planes yet, an old pose, planes past `valid_until`, incomplete or of an unknown tool | 0 |
/// | pose, planes or device silent for `silence` | from 1 down to 0 within `ramp` |
/// | otherwise | 1 |
ForcePermission decideForce(const ForceEvidence& evidence, const Instant& now, const ForceLimits& limits);

}  // namespace sweep_guard_core
