#pragma once

#include <string>
#include <vector>

namespace sweep_guard_evaluation {

/// A number in six digits; `nan`, `inf`.
std::string csvNumber(double value);

/// One line of a CSV file, its end included. A field with a comma, a quote or a line's end in it is quoted (RFC 4180).
std::string csvLine(const std::vector<std::string>& fields);

}  // namespace sweep_guard_evaluation
