#include "sweep_guard/common/printable.h"

#include <algorithm>
#include <cstdint>

namespace sweep_guard_core {
namespace {

// Returns the length of the printable UTF-8 character that the text begins with; 0: there is none.
size_t characterLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  if (byte(0) < 0xc2 || byte(0) > 0xf4) return 0;
  const size_t length = byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (text.size() < length) return 0;
  std::uint32_t character = byte(0) & (0xffU >> (length + 1));
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    character = character << 6U | (byte(i) & 0x3fU);
  }
  const bool control = character < 0xa0;
  const bool overlong = length > 2 && character < (length == 3 ? 0x800U : 0x10000U);
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  return control || overlong || surrogate || character > 0x10ffff ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, size_t max_length) {
  std::string shown;
  while (!text.empty()) {
    const size_t length = characterLength(text);
    if (shown.size() + std::max<size_t>(length, 1) > max_length) return shown + "...";
    length == 0 ? shown += '?' : shown += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return shown;
}

bool isName(std::string_view text) { return !text.empty() && text.size() <= kMaxNameLength && printable(text) == text; }

}  // namespace sweep_guard_core
