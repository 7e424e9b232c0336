#pragma once

#include <string>
#include <string_view>

namespace sweep_guard_core {

/// Largest length of a name that is taken from a message [bytes].
constexpr size_t kMaxNameLength = 128;

/// Returns a text for logs and displays. Every byte of a control character (line breaks, too) and of invalid UTF-8
/// becomes '?'. A longer text is cut before the character that exceeds `max_length`, and "..." is appended.
/// @param max_length  [bytes], without the "..."
std::string printable(std::string_view text, size_t max_length = kMaxNameLength);

/// Returns whether a text is a name: not empty, at most kMaxNameLength, and left as it is by printable().
bool isName(std::string_view text);

}  // namespace sweep_guard_core
