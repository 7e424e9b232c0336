#include "evaluation/csv.h"

#include <fmt/format.h>

namespace sweep_guard_evaluation {
namespace {

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string csvNumber(double value) { return fmt::format("{:.6g}", value); }

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& text : fields) line += (line.empty() ? "" : ",") + field(text);
  return line + '\n';
}

}  // namespace sweep_guard_evaluation
