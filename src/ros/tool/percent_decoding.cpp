#include "ros/tool/percent_decoding.h"

#include <algorithm>
#include <optional>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;

std::optional<unsigned> digit(const std::string& text, size_t at) {
  const auto found = std::string("0123456789abcdef0123456789ABCDEF").find(at < text.size() ? text[at] : ' ');
  if (found == std::string::npos) return {};
  return static_cast<unsigned>(found % 16);
}

std::string decodedPart(const std::string& part) {
  std::string decoded;
  for (size_t i = 0; i < part.size(); ++i) {
    const auto high = digit(part, i + 1);
    const auto low = digit(part, i + 2);
    decoded += part[i];
    if (part[i] != '%' || !high || !low) continue;
    decoded.back() = static_cast<char>(16 * *high + *low);
    if (decoded.back() == '\0' || decoded.back() == '/') {
      throw InvalidInput("'" + part.substr(i, 3) + "' is not supported; give the path without it");
    }
    i += 2;
  }
  if (decoded != part && (decoded == "." || decoded == "..")) {
    throw InvalidInput("'" + part + "' is not supported; write '" + decoded + "'");
  }
  return decoded;
}

}  // namespace

std::string percentDecoded(const std::string& path) {
  std::string decoded;
  for (size_t begin = 0; begin <= path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    decoded += decodedPart(path.substr(begin, end - begin));
    if (end < path.size()) decoded += '/';
    begin = end + 1;
  }
  return decoded;
}

}  // namespace sweep_guard_ros
