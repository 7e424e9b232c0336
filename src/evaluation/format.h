#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace sweep_guard_evaluation {

/// As std::snprintf; cut off after 500 characters.
template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 501> text;
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

}  // namespace sweep_guard_evaluation
