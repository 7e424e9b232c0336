#pragma once

#include <ros/time.h>
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Warning.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_rviz {

using sweep_guard_core::Instant;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::WarningLevel;

/// Returns a time of ROS on the clock of the core.
inline sweep_guard_core::Time toTime(const ros::Time& time) {
  return sweep_guard_core::Time(std::chrono::nanoseconds(time.toNSec()));
}

Instant currentInstant();

/// A warning with its time of arrival.
struct ReceivedWarning {
  sweep_guard::Warning warning;
  Instant received;
};

/// Age above which a warning is no longer shown: a little more than two periods of the warning. Together with the
/// panel's period and one frame of rviz this stays below 0.2 s at 20 frames per second or more.
constexpr auto kSilence = std::chrono::milliseconds(120);

/// Holds everything that the panel shows. A silent guard and a warning that is expired or contradicts itself give
/// kUnknown.
struct PanelState {
  WarningLevel level = WarningLevel::kUnknown;
  bool bright = true;                ///< alternates at 2 Hz while the tool touches; otherwise always true
  bool disabled = false;             ///< the guard reports that it is disabled
  bool acknowledged = false;         ///< the operator knows: drawn with less emphasis, never as clear
  bool silent = false;               ///< there is no valid warning
  std::string title;                 ///< name of the level, or `DISABLED`
  std::string time;                  ///< time to collision: `0.42 s`, `now`, or `-` for none, not known or over
  std::string meaning;               ///< explanation of `time`
  std::string target;                ///< object, triangles and tool link of the contact; empty: no contact
  std::vector<std::string> reasons;  ///< one sentence for each reason of the warning

  bool operator==(const PanelState& other) const;
};

/// Computes what the panel shows.
/// @param newest  the newest warning; empty if none has arrived
/// @param topic   topic of the warnings, named in the text
PanelState panelState(const std::optional<ReceivedWarning>& newest, const Instant& now, const std::string& topic);

/// Why a motion guard holds the robot back.
struct HeldState {
  bool stopped = false;  ///< nothing of the command is let through
  std::string text;      ///< empty: the command is passed on, or there is none
};

HeldState heldState(const sweep_guard::MotionStatus& status);

/// Returns the level of a warning of any age; kUnknown if the warning contradicts itself.
WarningLevel levelOf(const sweep_guard::Warning& warning);

/// Returns the time to collision [s]; empty if there is none or it is not known.
std::optional<double> timeToCollision(const sweep_guard::Warning& warning);

}  // namespace sweep_guard_rviz
