#pragma once

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

/// Times and levels by short names, for tests that write them in long lists.
namespace sweep_guard_core::timeline {

inline constexpr WarningLevel kUnknown = WarningLevel::kUnknown;
inline constexpr WarningLevel kClear = WarningLevel::kClear;
inline constexpr WarningLevel kConsidered = WarningLevel::kConsidered;
inline constexpr WarningLevel kReflex = WarningLevel::kReflex;
inline constexpr WarningLevel kContact = WarningLevel::kContact;

/// Returns the time that is so many milliseconds after the epoch.
inline Time at(int ms) { return Time(std::chrono::milliseconds(ms)); }

}  // namespace sweep_guard_core::timeline
