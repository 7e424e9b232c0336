#include "common/number_text.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>
#include <type_traits>

namespace sweep_guard_core {
namespace {

template <typename Integer>
std::optional<Integer> parseInteger(std::string_view text) {
  Integer number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

void convert(const char* text, char** end, locale_t locale, double& number) { number = strtod_l(text, end, locale); }
void convert(const char* text, char** end, locale_t locale, long double& number) {
  number = strtold_l(text, end, locale);
}

template <typename Real>
std::optional<Real> parseReal(std::string_view text) {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  if (text.empty() || text.find_first_of(" \t\n\v\f\rxX") != std::string_view::npos || text.front() == '+')
    return std::nullopt;
  const std::string ended(text);
  char* end = nullptr;
  Real number = 0;
  errno = 0;
  convert(ended.c_str(), &end, classic, number);
  const bool fits =
      errno != ERANGE || (number != 0 && std::isfinite(number));  // glibc says ERANGE of subnormal ones, too
  return fits && end == ended.c_str() + ended.size() ? std::optional(number) : std::nullopt;
}

}  // namespace

template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
  if constexpr (std::is_integral_v<Number>) {
    return parseInteger<Number>(text);
  } else {
    return parseReal<Number>(text);
  }
}

template std::optional<int> parseNumber(std::string_view text);
template std::optional<std::size_t> parseNumber(std::string_view text);
template std::optional<double> parseNumber(std::string_view text);
template std::optional<long double> parseNumber(std::string_view text);

std::string shortestText(double number) {
  using Limits = std::numeric_limits<double>;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  for (int digits = Limits::digits10; digits <= Limits::max_digits10; ++digits) {
    text.str("");
    text.precision(digits);
    text << number;
    if (parseNumber<double>(text.str()) == number) break;
  }
  return text.str();
}

std::string shortText(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << number;
  return text.str();
}

std::string inSeconds(Duration duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f s", toSeconds(duration));
  return text.data();
}

}  // namespace sweep_guard_core
