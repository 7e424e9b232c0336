#include "ros/scene/message_definition.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "common/number_text.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using std::string_view;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;
using Kind = ValueType::Kind;
using Types = std::map<std::string, ValueType>;

constexpr size_t kMaxDefinition = size_t{256} << 10U;  // [bytes]; bounds the number of types and fields, too
constexpr size_t kMaxValueSize = size_t{1} << 30U;     // [bytes]; roscpp takes messages up to 1e9
constexpr int kMaxDepth = 32;
constexpr string_view kBlanks = " \t\r\v\f";

struct Builtin {
  const char* name;
  Kind kind;
  size_t size;  // [bytes]
};
constexpr Builtin kBuiltins[] = {
    {"bool", Kind::kBool, 1},       {"byte", Kind::kSigned, 1},     {"char", Kind::kUnsigned, 1},
    {"int8", Kind::kSigned, 1},     {"uint8", Kind::kUnsigned, 1},  {"int16", Kind::kSigned, 2},
    {"uint16", Kind::kUnsigned, 2}, {"int32", Kind::kSigned, 4},    {"uint32", Kind::kUnsigned, 4},
    {"int64", Kind::kSigned, 8},    {"uint64", Kind::kUnsigned, 8}, {"float32", Kind::kFloat, 4},
    {"float64", Kind::kFloat, 8},   {"time", Kind::kTime, 8},       {"duration", Kind::kDuration, 8},
    {"string", Kind::kString, 4},
};

string_view trimmed(string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// Removes the first line from the text, and returns it without comment.
string_view takeLine(string_view& text) {
  const string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return trimmed(line.substr(0, line.find('#')));
}

[[noreturn]] void refuseType(const std::string& name, const std::string& problem) {
  throw InvalidInput("message definition is not usable: " + printable(name) + " " + problem);
}

// Reads only the types that the message needs.
class DefinitionReader {
 public:
  DefinitionReader(const std::string& datatype, string_view text, Types& types) : types_(types) {
    addBuiltins();
    divide(datatype, text);
  }

  // A type of which no value is known to take a byte is still being read.
  const ValueType& read(const std::string& name, int depth) {
    if (depth > kMaxDepth) refuseType(name, "is more than " + std::to_string(kMaxDepth) + " levels deep");
    if (name.size() > sweep_guard_core::kMaxNameLength) refuseType(name, "is too long");
    const auto [entry, is_new] = types_.try_emplace(name);
    ValueType& type = entry->second;
    if (!is_new && type.min_size == 0) refuseType(name, "is part of itself");
    if (!is_new) return type;
    type.name = name;
    const size_t size = name.find('[') != std::string::npos ? readArray(type, depth) : readMessage(type, depth);
    if (size == 0) refuseType(name, "is empty");
    if (size > kMaxValueSize) refuseType(name, "takes more than 1 GiB");
    type.min_size = size;
    return type;
  }

 private:
  struct Declaration {
    string_view type, name;
  };

  void addBuiltins() {
    for (const auto& [name, kind, size] : kBuiltins) types_[name] = {name, kind, size, /*fixed=*/true, nullptr, 0, {}};
    types_["string"].fixed = false;
    types_["string"].element = &types_["uint8"];
  }

  // Lines between sections consist of '=', as constants contain it.
  void divide(const std::string& datatype, string_view text) {
    auto* section = &sections_[datatype];
    while (!text.empty()) {
      const string_view line = takeLine(text);
      if (line.substr(0, 4) == "MSG:") {
        const auto [entry, is_new] = sections_.try_emplace(std::string(trimmed(line.substr(4))));
        if (!is_new) refuseType(entry->first, "is defined twice");
        section = &entry->second;
      } else if (!line.empty() && line.find('=') == string_view::npos) {
        section->push_back(declarationIn(line));
      }
    }
  }

  static Declaration declarationIn(string_view line) {
    const string_view type = line.substr(0, line.find_first_of(kBlanks));
    const string_view name = trimmed(line.substr(type.size()));
    if (name.empty() || name.find_first_of(kBlanks) != string_view::npos) {
      refuseType("'" + std::string(line) + "'", "is not a field");
    }
    return {type, name};
  }

  size_t readArray(ValueType& type, int depth) {
    const size_t bracket = type.name.find('[');
    type.kind = Kind::kArray;
    type.element = &read(type.name.substr(0, bracket), depth + 1);
    const string_view length = string_view(type.name).substr(bracket + 1);
    if (length == "]") return sizeof(std::uint32_t);
    const auto count = sweep_guard_core::parseNumber<size_t>(length.substr(0, length.size() - 1));
    if (type.name.back() != ']' || !count || *count > kMaxValueSize) refuseType(type.name, "is no array");
    type.length = *count;
    type.fixed = type.element->fixed;
    return *count * type.element->min_size;
  }

  size_t readMessage(ValueType& type, int depth) {
    const auto section = sections_.find(type.name);
    if (section == sections_.end()) refuseType(type.name, "is missing");
    size_t size = 0;
    type.fixed = true;
    for (const Declaration& declared : section->second) {
      const ValueType& field = read(fullName(declared.type, type.name), depth + 1);
      type.fields.push_back({std::string(declared.name), &field});
      type.fixed = type.fixed && field.fixed;
      size += field.min_size;
    }
    return size;
  }

  std::string fullName(string_view written, const std::string& owner) const {
    const std::string base(written.substr(0, written.find('[')));
    if (base == "Header") return "std_msgs/" + std::string(written);
    if (base.find('/') != std::string::npos || types_.count(base) != 0) return std::string(written);
    return owner.substr(0, owner.find('/') + 1) + std::string(written);
  }

  std::map<std::string, std::vector<Declaration>> sections_;
  Types& types_;
};

}  // namespace

MessageDefinition::MessageDefinition(const std::string& datatype, const std::string& text) {
  if (text.size() > kMaxDefinition) refuseType(datatype, "has a text of more than 256 KiB");
  type_ = &DefinitionReader(datatype, text, types_).read(datatype, 0);
}

}  // namespace sweep_guard_ros
