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

std::vector<std::string> csvFields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const bool doubled = quoted && line.compare(i, 2, "\"\"") == 0;
    if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else if (line[i] != '"' || doubled) {
      fields.back() += line[i];
      i += doubled ? 1 : 0;
    } else {
      quoted = !quoted;
    }
  }
  return fields;
}

}  // namespace sweep_guard_evaluation
