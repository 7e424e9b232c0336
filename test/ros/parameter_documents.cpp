#include "ros/parameter_documents.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>
#include <sstream>

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kLineLength = 118;
const std::string kChanges = "# doc/interface.md tells which parameters can change while the node runs.\n";

// @param changes  a line about parameters that change while the node runs; empty: none does
std::string head(const std::string& node, const std::string& changes, const std::string& source) {
  return "# Every parameter of " + node +
         " with its default. The comment above a key tells type, unit, range and effect.\n"
         "# A wrong type, NaN or a value out of range stops the node at start with one line. An unknown key raises a "
         "warning.\n" +
         changes + "# This file is written from " + source + ", as CONTRIBUTING.md explains.\n";
}

std::string groupOf(const std::string& key) {
  const size_t slash = key.find('/');
  return slash == std::string::npos ? "" : key.substr(0, slash);
}

// Parameters without a group are first; the groups follow in the order of reading.
std::vector<ParameterInfo> grouped(const std::vector<ParameterInfo>& infos) {
  std::vector<std::string> groups = {""};
  for (const ParameterInfo& info : infos) {
    if (std::count(groups.begin(), groups.end(), groupOf(info.key)) == 0) groups.push_back(groupOf(info.key));
  }
  std::vector<ParameterInfo> ordered;
  for (const std::string& group : groups) {
    std::copy_if(infos.begin(), infos.end(), std::back_inserter(ordered),
                 [&](const ParameterInfo& info) { return groupOf(info.key) == group && !info.effect.empty(); });
  }
  return ordered;
}

std::string commented(const std::string& text, const std::string& indent) {
  std::string comment;
  std::string line = indent + "#";
  std::istringstream words(text);
  for (std::string word; words >> word; line += " " + word) {
    if (line.size() + 1 + word.size() <= kLineLength) continue;
    comment += line + "\n";
    line = indent + "#";
  }
  return comment + line + "\n";
}

std::string capitalized(std::string text) {
  const size_t first = text.front() == '[' ? text.find("] ") + 2 : 0;
  text[first] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[first])));
  return text;
}

std::string fallbackOf(const ParameterInfo& info) {
  const std::string text = shown(info.fallback);
  return text.empty() ? "''" : text;
}

// The default tells that a text, a list or a group may be empty.
std::string typeOf(const ParameterInfo& info) {
  const std::regex left_out("a number from |^(one of|an?) |, not empty|, or (empty|\\[\\]|\\{\\})");
  return std::regex_replace(info.wanted, left_out, "");
}

std::string keyOf(const ParameterInfo& info) {
  const std::string key = "`" + info.key + "`";
  return info.live ? "**" + key + "**" : key;
}

std::string cellsOf(const ParameterInfo& info) {
  return " | `" + fallbackOf(info) + "` | " + typeOf(info) + " | " + info.effect + " |";
}

std::string entries(const std::vector<ParameterInfo>& infos) {
  std::string text;
  std::string group;
  for (const ParameterInfo& info : grouped(infos)) {
    if (groupOf(info.key) != group) {
      group = groupOf(info.key);
      text += "\n" + group + ":\n";
    } else if (group.empty()) {
      text += "\n";
    }
    const std::string indent = group.empty() ? "" : "  ";
    const std::string name = info.key.substr(group.empty() ? 0 : group.size() + 1);
    text += commented(capitalized(info.wanted) + ". " + info.effect, indent);
    text += indent + name + ": " + fallbackOf(info) + "\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> parameterRows(const std::vector<ParameterInfo>& infos) {
  std::vector<std::string> rows;
  std::string keys;
  std::string cells;
  for (const ParameterInfo& info : grouped(infos)) {
    const bool shares_row = !rows.empty() && cellsOf(info) == cells;
    if (shares_row) rows.pop_back();
    keys = (shares_row ? keys + ", " : "") + keyOf(info);
    cells = cellsOf(info);
    rows.push_back("| " + keys + cells);
  }
  return rows;
}

std::string configurationFile(const std::vector<ParameterInfo>& infos) {
  return head("sweep_guard_node", kChanges, "src/ros/parameters/parameters.cpp") + entries(infos);
}

std::string motionConfigurationFile(const std::vector<ParameterInfo>& infos) {
  return head("motion_guard", "", "src/ros/motion/motion_parameters.cpp") + entries(infos);
}

std::string blackBoxConfigurationFile(const std::vector<ParameterInfo>& infos) {
  return head("black_box", "", "src/ros/black_box/black_box_parameters.cpp") + entries(infos);
}

std::string hapticsConfigurationFile(const std::vector<ParameterInfo>& infos) {
  return head("haptics", "", "src/ros/haptics/haptics_parameters.cpp") + entries(infos);
}

}  // namespace sweep_guard_ros
