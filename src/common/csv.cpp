#include "common/csv.h"

#include <cstddef>
#include <locale>
#include <sstream>

namespace sweep_guard_core {
namespace {

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string csvNumber(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& text : fields) line += (line.empty() ? "" : ",") + csvField(text);
  return line + '\n';
}

std::vector<std::string> csvFields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
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

}  // namespace sweep_guard_core
