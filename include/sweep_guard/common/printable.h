#pragma once

#include <string>
#include <string_view>

namespace sweep_guard_core {

/// Largest length of a name that is taken from a message [bytes].
constexpr size_t kMaxNameLength = 128;

/// Returns a text for logs and displays: control characters and bytes that are no UTF-8 become '?', and what exceeds the
/// largest length becomes "...".
std::string printable(std::string_view text, size_t max_length = kMaxNameLength);

/// Returns whether a text is a name: not empty, and left as it is by printable().
bool isName(std::string_view text);

}  // namespace sweep_guard_core
