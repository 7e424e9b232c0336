#pragma once

#include <string>
#include <vector>

namespace sweep_guard_core {

/// Formats a number with six significant digits, the same in every locale; `nan` and `inf` for the others.
std::string csvNumber(double value);

/// Formats one line of a CSV file with its line feed. Quotes a field that contains a comma, a quote or a line break
/// (RFC 4180).
std::string csvLine(const std::vector<std::string>& fields);

/// Returns the fields of one line without its line feed: the inverse of csvLine(), for fields without line breaks.
std::vector<std::string> csvFields(const std::string& line);

}  // namespace sweep_guard_core
