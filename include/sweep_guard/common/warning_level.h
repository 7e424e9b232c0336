#pragma once

#include <array>
#include <cstdint>

namespace sweep_guard_core {

/// The level of a warning. msg/Warning.msg has the same numbers and explains them. The numbers do not rank urgency:
/// kUnknown is not weaker than kClear.
enum class WarningLevel : std::uint8_t { kUnknown = 0, kClear = 1, kConsidered = 2, kReflex = 3, kContact = 4 };

/// Gives a level its name and its color in logs, markers, panel, reports and pictures. Levels differ by name; kReflex
/// and kContact share their color.
struct LevelStyle {
  const char* name;
  std::array<std::uint8_t, 3> rgb;
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
