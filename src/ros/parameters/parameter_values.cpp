#include "ros/parameters/parameter_values.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "common/number_text.h"

namespace sweep_guard_ros {
namespace {

constexpr const char* kTrimmed = " '\"";

// YAML 1.1 takes 1e-06 for a text, and 1.0e-06 for a number.
std::string yamlNumber(std::string text) {
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

}  // namespace

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

std::string withUnit(const ParameterRange& range) {
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

std::string grouped(const std::vector<std::string>& names, const std::vector<std::string>& texts) {
  std::vector<std::string> entries;
  for (size_t i = 0; i < names.size(); ++i) entries.push_back(names[i] + ": " + texts[i]);
  return "{" + listed(entries) + "}";
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

std::string shown(const ParameterValue& value) {
  std::ostringstream text;
  text << std::boolalpha;
  std::visit([&](const auto& held) { text << held; }, value);
  return std::holds_alternative<double>(value) ? yamlNumber(text.str()) : text.str();
}

}  // namespace sweep_guard_ros
