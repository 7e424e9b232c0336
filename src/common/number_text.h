#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

// Numbers as text, the same in every locale. std::from_chars and std::to_chars lack floating point before libstdc++ 11.

/// Reads a text that is one decimal number and nothing else: no blanks, no `+` before it. "inf" and "nan" are numbers.
/// @tparam Number  int, size_t, double or long double
/// @returns nothing if the text is something else, or if the number is too large or too close to 0 for its type
template <typename Number>
std::optional<Number> parseNumber(std::string_view text);

/// Returns the decimal number with the fewest digits that is read as the same number.
std::string shortestText(double number);

/// Returns the number with six digits at most, for people: as in "0.25" or "1e+227".
std::string shortText(double number);

/// Returns a duration with two decimals and its unit, as in "0.25 s".
std::string inSeconds(Duration duration);

}  // namespace sweep_guard_core
