#pragma once

#include <array>
#include <cstdint>

namespace sweep_guard_core {

/// Level of the warning. Numbers equal those of sweep_guard/Warning; they do not order urgency: unknown is not weaker than clear.
enum class WarningLevel : std::uint8_t { kUnknown = 0, kClear = 1, kConsidered = 2, kReflex = 3, kContact = 4 };

/// Name and color of a level: the one table that log, markers, panel, reports and pictures use.
struct LevelStyle {
  const char* name;
  std::array<std::uint8_t, 3> rgb;
};

constexpr std::array<LevelStyle, 5> kLevelStyles = {{
    {"UNKNOWN", {140, 140, 140}},
    {"CLEAR", {51, 191, 77}},
    {"CONSIDERED", {255, 179, 26}},
    {"REFLEX", {242, 38, 26}},
    {"CONTACT", {242, 38, 26}},
}};

constexpr const LevelStyle& styleOf(WarningLevel level) { return kLevelStyles[static_cast<std::size_t>(level)]; }

}  // namespace sweep_guard_core
