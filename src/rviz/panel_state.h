#pragma once

#include <ros/time.h>
#include <sweep_guard/Warning.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sweep_guard_rviz {

using SteadyTime = std::chrono::steady_clock::time_point;

/// What the traffic light shows. The order is that of the levels of a Warning.
enum class Light : std::uint8_t { kUnknown = 0, kClear = 1, kConsidered = 2, kReflex = 3, kContact = 4 };

/// A time on both clocks.
struct Moment {
  SteadyTime steady;
  ros::Time stamp;
};

Moment currentMoment();

/// A warning, and when it came in.
struct ReceivedWarning {
  sweep_guard::Warning warning;
  Moment received;
};

/// A warning older than this is no longer shown: two periods of the warning, and some. With the period in which the
/// panel looks, and the frame that rviz may be drawing then, less than 0.2 s at 20 frames per second or more.
constexpr auto kSilence = std::chrono::milliseconds(120);

/// Everything the panel says, in words. Silence, what contradicts itself and what is out of date are unknown.
struct PanelState {
  Light light = Light::kUnknown;
  bool bright = true;             ///< half of the time in contact, which flashes at 2 Hz; else always
  bool disabled = false;          ///< the guard says that it is switched off
  bool silent = false;            ///< there is no warning to go by
  std::string word;               ///< the level: `UNKNOWN`, `CLEAR`, ...
  std::string time;               ///< to the collision: `0.42 s`, `now`, or `-` for none or not known
  std::string meaning;            ///< of the time, or what to make of its absence
  std::string target;             ///< what is or will be hit: object, triangles, tool link; empty: nothing
  std::vector<std::string> whys;  ///< why it is not clear, or what is degraded; one sentence each

  bool operator==(const PanelState& other) const;
  bool operator!=(const PanelState& other) const { return !(*this == other); }
};

/// @param newest  empty: none has come
/// @param topic   where they come from, for the words
PanelState panelState(const std::optional<ReceivedWarning>& newest, const Moment& now, const std::string& topic);

/// The light of a warning as it stands, whatever its age.
Light lightOf(const sweep_guard::Warning& warning);

/// Time to collision [s]; empty: none, or not known.
std::optional<double> timeToCollision(const sweep_guard::Warning& warning);

}  // namespace sweep_guard_rviz
