#include "session/session_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNamed = 5;   // of different parameters
constexpr std::size_t kMaxValue = 40;  // of characters
constexpr const char* kNotSet = "not set";

using Values = std::map<std::string, std::string>;  // by name, with its groups

fs::path configBeside(const std::string& bag) { return fs::path(bag).replace_extension(".yaml"); }

bool isSame(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return a == b || fs::equivalent(a, b, none);
}

std::string withoutQuotes(std::string key) {
  key.erase(std::remove(key.begin(), key.end(), '"'), key.end());
  return key;
}

// As the black box writes them: a parameter or a group a line, groups by indentation of two.
Values readValues(const fs::path& path) {
  Values values;
  std::vector<std::string> groups;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || line[indent] == '#') continue;
    const std::size_t colon = line.find(':', line[indent] == '"' ? line.find('"', indent + 1) : indent);
    if (colon == std::string::npos) continue;
    groups.resize(std::min(indent / 2, groups.size()));
    const std::string name = withoutQuotes(line.substr(indent, colon - indent));
    std::string prefix;
    for (const std::string& group : groups) prefix += group + '/';
    groups.push_back(name);
    if (const std::size_t value = line.find_first_not_of(' ', colon + 1); value != std::string::npos) {
      values[prefix + name] = line.substr(value);
    }
  }
  return values;
}

std::string valueOf(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? kNotSet : sweep_guard_core::printable(found->second, kMaxValue);
}

// warning/hold_time 0.5 instead of 1
std::string differences(const Values& used, const Values& own) {
  Values names = used;
  names.insert(own.begin(), own.end());
  std::string text;
  std::size_t count = 0;
  for (const auto& [name, any] : names) {
    const auto in_used = used.find(name);
    const auto in_own = own.find(name);
    if (in_used != used.end() && in_own != own.end() && in_used->second == in_own->second) continue;
    if (++count > kMaxNamed) continue;
    text += fmt::format("{}{} {} instead of {}", count > 1 ? ", " : "", sweep_guard_core::printable(name),
                        valueOf(used, name), valueOf(own, name));
  }
  return count > kMaxNamed ? text + fmt::format(", and {} more", count - kMaxNamed) : text;
}

}  // namespace

std::vector<std::string> describeConfig(const std::string& config, const std::vector<std::string>& bags) {
  if (config.empty()) return {};
  std::vector<std::string> lines = {config};
  const auto belongs = [&config](const std::string& bag) { return isSame(configBeside(bag), config); };
  if (std::none_of(bags.begin(), bags.end(), belongs)) return lines;
  const Values used = readValues(config);
  for (const std::string& bag : bags) {
    std::error_code none;
    if (belongs(bag) || !fs::exists(configBeside(bag), none)) continue;
    const std::string text = differences(used, readValues(configBeside(bag)));
    if (text.empty()) continue;
    lines.push_back("it differs from that of " + bag + ", which is played with " + text +
                    ". Replay them one by one, or give config:=FILE");
  }
  return lines;
}

}  // namespace sweep_guard_session
