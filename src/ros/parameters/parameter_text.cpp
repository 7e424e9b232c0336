#include "ros/parameters/parameter_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "common/number_text.h"

namespace sweep_guard_ros {
namespace {

void flatten(const XmlRpc::XmlRpcValue& group, const std::string& prefix,
             std::map<std::string, XmlRpc::XmlRpcValue>& entries) {
  for (const auto& [name, value] : group) {
    if (value.getType() == XmlRpc::XmlRpcValue::TypeStruct && value.size() > 0) {
      flatten(value, prefix + name + "/", entries);
    } else {
      entries[prefix + name] = value;
    }
  }
}

// Returns what YAML takes for the number that the text says; empty if it says none.
std::string yamlOf(std::string text) {
  if (text.compare(0, 1, "+") == 0) text.erase(0, 1);
  const auto number = sweep_guard_core::parseNumber<double>(text);
  if (!number || std::isnan(*number)) return "";
  if (std::isinf(*number)) return *number > 0.0 ? ".inf" : "-.inf";
  return yamlNumber(std::move(text));
}

}  // namespace

std::map<std::string, XmlRpc::XmlRpcValue> flattened(const XmlRpc::XmlRpcValue& group) {
  std::map<std::string, XmlRpc::XmlRpcValue> entries;
  flatten(group, "", entries);
  return entries;
}

std::string yamlNumber(std::string text) {
  const size_t point = text.find('.');
  if (point != std::string::npos && text.find_first_of("0123456789") > point) text.insert(point, "0");
  const size_t exponent = text.find_first_of("eE");
  if (exponent == std::string::npos) return text;
  if (text.find_first_of("+-", exponent) == std::string::npos) text.insert(exponent + 1, "+");
  if (point == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string noteOnText(const XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeArray) {
    std::string note;
    for (int i = 0; note.empty() && i < value.size(); ++i) note = noteOnText(value[i]);
    return note;
  }
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) return "";
  const std::string text = static_cast<std::string>(value);
  const std::string yaml = yamlOf(text);
  return yaml.empty() ? "" : "; '" + text + "' is a text: YAML wants " + yaml + ", without quotes";
}

double toNumber(const XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) return static_cast<double>(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return static_cast<int>(value);
  return std::numeric_limits<double>::quiet_NaN();
}

bool within(double number, const ParameterRange& range) { return number >= range.lowest && number <= range.highest; }

bool within(const XmlRpc::XmlRpcValue& value, int lowest, int highest) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeInt) return false;
  return static_cast<int>(value) >= lowest && static_cast<int>(value) <= highest;
}

std::string shown(const ParameterRange& range) {
  std::ostringstream text;
  text << "a number from " << range.lowest << " to " << range.highest;
  return text.str();
}

std::string described(const ParameterRange& range) {
  const std::string unit = range.unit;
  return (unit.empty() ? "" : "[" + unit + "] ") + shown(range);
}

std::string shown(int lowest, int highest) {
  return " from " + std::to_string(lowest) + " to " + std::to_string(highest);
}

std::string listed(const std::vector<std::string>& choices) {
  std::string list;
  for (const std::string& choice : choices) list += (list.empty() ? "" : ", ") + choice;
  return list;
}

XmlRpc::XmlRpcValue split(std::string text) {
  constexpr const char* kTrimmed = " '\"";
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
  XmlRpc::XmlRpcValue list;
  list.setSize(0);
  if (text.empty()) return list;
  std::istringstream words(text + ',');
  for (std::string word; std::getline(words, word, ',');) {
    const size_t begin = std::min(word.find_first_not_of(kTrimmed), word.size());
    list[list.size()] = word.substr(begin, word.find_last_not_of(kTrimmed) + 1 - begin);
  }
  return list;
}

XmlRpc::XmlRpcValue toInteger(const XmlRpc::XmlRpcValue& value) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) return value;
  const auto number = sweep_guard_core::parseNumber<int>(static_cast<std::string>(value));
  return number ? XmlRpc::XmlRpcValue(*number) : value;
}

std::string bracketed(const std::vector<std::string>& words) { return "[" + listed(words) + "]"; }

std::string braced(const std::vector<std::string>& entries) { return "{" + listed(entries) + "}"; }

std::string grouped(const std::vector<std::string>& names, const std::vector<std::string>& texts) {
  std::vector<std::string> entries;
  for (size_t i = 0; i < names.size(); ++i) entries.push_back(names[i] + ": " + texts[i]);
  return braced(entries);
}

std::vector<std::string> textsOf(XmlRpc::XmlRpcValue& group, const std::vector<std::string>& names) {
  if (group.getType() != XmlRpc::XmlRpcValue::TypeStruct || group.size() != static_cast<int>(names.size())) return {};
  std::vector<std::string> texts;
  for (const std::string& name : names) {
    if (!group.hasMember(name) || group[name].getType() != XmlRpc::XmlRpcValue::TypeString) return {};
    texts.push_back(static_cast<std::string>(group[name]));
    if (texts.back().empty()) return {};
  }
  return texts;
}

std::string bracketed(const std::vector<int>& integers) {
  std::vector<std::string> words;
  words.reserve(integers.size());
  for (const int integer : integers) words.push_back(std::to_string(integer));
  return bracketed(words);
}

}  // namespace sweep_guard_ros
