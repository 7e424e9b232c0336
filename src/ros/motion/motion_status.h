#pragma once

#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Proximity.h>

#include <optional>
#include <string>

#include "ros/motion/command_port.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_ros {

/// Describes what was sent for a command. The caller sets the header.
/// @param planes  message that the planes are from; null without planes
/// @param lead    how far what was sent is ahead of a tool that does not follow it; empty: it follows
sweep_guard::MotionStatus statusOf(const sweep_guard_core::GuardedMotion& motion, const sweep_guard::Proximity* planes,
                                   const std::optional<sweep_guard_core::Moved>& lead);

/// Describes that a command could not be carried out.
/// @param reason  whole text
sweep_guard::MotionStatus refusedStatus(const std::string& reason);

/// Describes that there is no command.
sweep_guard::MotionStatus idleStatus(const sweep_guard_core::PermissionDecision& decision);

/// Returns whether two statuses differ for a reader: their ages and times may.
bool differ(const sweep_guard::MotionStatus& a, const sweep_guard::MotionStatus& b);

}  // namespace sweep_guard_ros
