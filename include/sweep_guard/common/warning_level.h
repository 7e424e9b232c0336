#pragma once

#include <array>
#include <cstdint>

namespace sweep_guard_core {

/// The level of a warning; msg/Warning.msg has the same numbers. They do not rank urgency: kUnknown is not weaker than
/// kClear.
enum class WarningLevel : std::uint8_t {
  kUnknown = 0,     ///< nothing can be promised
  kClear = 1,       ///< inputs are fresh, and everything tested is free, including the predicted path
  kConsidered = 2,  ///< contact is predicted within the considered interval (WarningLimits)
  kReflex = 3,      ///< contact is predicted within the reflex interval (WarningLimits)
  kContact = 4      ///< the tool has met a workpiece, or it is not ruled out that it has
};

/// Gives a level its name and its color in logs, markers, panel, reports and pictures. Levels differ by name; kReflex
/// and kContact share their color.
struct LevelStyle {
  const char* name;
  std::array<std::uint8_t, 3> rgb;  ///< red, green, blue, each 0 to 255
};

constexpr std::array<LevelStyle, 5> kLevelStyles = {{
    {"UNKNOWN", {140, 140, 140}},
    {"CLEAR", {46, 176, 92}},
    {"CONSIDERED", {255, 176, 0}},
    {"REFLEX", {222, 26, 26}},
    {"CONTACT", {222, 26, 26}},
}};

constexpr const LevelStyle& styleOf(WarningLevel level) { return kLevelStyles[static_cast<std::size_t>(level)]; }

}  // namespace sweep_guard_core
