#pragma once

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "common/number_text.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

/// Describes an option that takes a text.
inline auto text(std::string& word, const char* name) { return boost::program_options::value(&word)->value_name(name); }
inline auto withDefault(const std::string& word, const char* name) {
  return boost::program_options::value<std::string>()->value_name(name)->default_value(word);
}

/// Returns the number in the text of an option.
/// @throws sweep_guard_core::InvalidInput  that names the option, if it is no number in [lower, upper]
template <typename Number>
Number toNumber(const std::string& option, const std::string& word, Number lower, Number upper) {
  const std::optional<Number> number = sweep_guard_core::parseNumber<Number>(word);
  if (number && *number >= lower && *number <= upper) return *number;
  throw sweep_guard_core::InvalidInput(fmt::format("--{}: '{}' is not {} in [{}, {}]", option, word,
                                                   std::is_integral_v<Number> ? "a whole number" : "a number", lower,
                                                   upper));
}

/// Returns the words of a list with commas between them.
std::vector<std::string> splitAtCommas(const std::string& list);

/// Parses a command line of options and files, and stores what it says.
/// @throws sweep_guard_core::InvalidInput that names an option that is unknown or lacks its value
boost::program_options::variables_map parseCommandLine(int argc, const char* const* argv,
                                                       boost::program_options::options_description options,
                                                       std::vector<std::string>& files);

}  // namespace sweep_guard_evaluation
