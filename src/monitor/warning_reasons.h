#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {

/// Pieces of a text. They are assembled where the text is kept: a repeated warning allocates nothing.
using TextPieces = std::initializer_list<std::string_view>;

inline void insertText(std::string& text, size_t place, TextPieces pieces) {
  for (const std::string_view piece : pieces) {
    text.insert(place, piece);
    place += piece.size();
  }
}

/// Adds a reason, and its message to the end of the text.
inline void addReason(Warning& warning, Reason reason, TextPieces message) {
  warning.reasons |= reason;
  if (!warning.text.empty()) warning.text += "; ";
  insertText(warning.text, warning.text.size(), message);
}

/// Adds all reasons for which the warning may not be CLEAR or is degraded, each with its text.
void addReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning);

}  // namespace sweep_guard_core
