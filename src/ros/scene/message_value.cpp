#include "ros/scene/message_value.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;
using sweep_guard_core::Triangle;
using Positions = std::vector<Eigen::Vector3d>;
using Kind = ValueType::Kind;

constexpr size_t kMaxElements = 1'000'000;

[[noreturn]] void refuseCutOff(size_t size, Wire message, size_t at) {
  throw InvalidInput("message is cut off: it takes at least " + std::to_string(at + size) + " bytes and holds " +
                     std::to_string(message.size) + " bytes");
}

void requireBytes(size_t size, Wire message, size_t at) {
  if (size > message.size - at) refuseCutOff(size, message, at);
}

const ValueType& contentOf(const ValueType& record) {
  return record.fields.size() == 1 ? *record.fields.front().type : record;
}

// Returns where a value ends. Every value takes a byte, so no more values are passed than the message has bytes.
size_t endOf(const ValueType& value, Wire message, size_t at) {
  const ValueType& type = contentOf(value);
  requireBytes(type.min_size, message, at);
  if (type.fixed) return at + type.min_size;
  for (const auto& field : type.fields) at = endOf(*field.type, message, at);
  if (type.element == nullptr) return at;
  size_t count = type.length;
  if (count == 0) {
    count = numberAt<std::uint32_t>(message.bytes + at);
    at += sizeof(std::uint32_t);
  }
  requireBytes(count * type.element->min_size, message, at);
  if (type.element->fixed) return at + count * type.element->min_size;
  for (; count > 0; --count) at = endOf(*type.element, message, at);
  return at;
}

bool isIndex(const ValueType& type) { return type.kind == Kind::kUnsigned && type.min_size == sizeof(std::uint32_t); }

bool isIndices(const ValueType& type, size_t length) {
  return type.kind == Kind::kArray && isIndex(*type.element) && type.length == length;
}

template <typename Number>
std::optional<size_t> offsetOf(const char* name, const ValueType& record) {
  size_t offset = 0;
  for (const auto& [known, type] : record.fields) {
    if (known == name && type->kind == Kind::kFloat && type->min_size == sizeof(Number)) return offset;
    offset += type->min_size;
  }
  return std::nullopt;
}

template <typename Number>
std::optional<Positions> positionsIn(Wire records, const ValueType& record) {
  const auto x = offsetOf<Number>("x", record);
  const auto y = offsetOf<Number>("y", record);
  const auto z = offsetOf<Number>("z", record);
  if (!x || !y || !z) return std::nullopt;
  Positions positions(records.size / record.min_size);
  const std::uint8_t* bytes = records.bytes;
  for (Eigen::Vector3d& p : positions) {
    p = {numberAt<Number>(bytes + *x), numberAt<Number>(bytes + *y), numberAt<Number>(bytes + *z)};
    bytes += record.min_size;
  }
  return positions;
}

}  // namespace

MessageValue::MessageValue(const MessageDefinition& definition, Wire message)
    : MessageValue(definition.type(), definition.type().name, message, 0) {
  const size_t end = endOf(*type_, message, 0);
  if (end == message.size) return;
  throw InvalidInput("message is too long for its type: it takes " + std::to_string(end) + " bytes and holds " +
                     std::to_string(message.size) + " bytes");
}

void MessageValue::require(bool right, const char* wanted) const {
  if (right) return;
  throw InvalidInput("field '" + printable(*name_) + "' is " + printable(type_->name) + ", not " + wanted +
                     ": this version is not known");
}

void MessageValue::refuseContent(const char* content) const {
  throw InvalidInput("field '" + printable(*name_) + "' has " + content);
}

bool MessageValue::has(std::string_view field) const {
  const auto& fields = type_->fields;
  return std::any_of(fields.begin(), fields.end(), [&](const auto& known) { return known.name == field; });
}

MessageValue MessageValue::operator[](std::string_view field) const {
  size_t at = at_;
  for (const auto& [name, type] : type_->fields) {
    if (name == field) return {*type, name, message_, at};
    at = endOf(*type, message_, at);
  }
  throw InvalidInput(printable(type_->name) + " has no field '" + printable(field) + "': this version is not known");
}

template <typename Number>
Number MessageValue::read(size_t offset) const {
  return numberAt<Number>(message_.bytes + at_ + offset);
}

double MessageValue::number() const {
  if (type_->kind != Kind::kFloat) return static_cast<double>(integer());
  return type_->min_size == sizeof(float) ? read<float>() : read<double>();
}

std::int64_t MessageValue::integer() const {
  const bool is_signed = type_->kind == Kind::kSigned;
  std::uint64_t bits = 0;
  require(is_signed || (type_->kind == Kind::kUnsigned && type_->min_size < sizeof bits), "an integer up to int64");
  std::memcpy(&bits, message_.bytes + at_, type_->min_size);
  const size_t unused = is_signed ? 8 * (sizeof bits - type_->min_size) : 0;
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

bool MessageValue::flag() const {
  require(type_->kind == Kind::kBool, "a bool");
  return read<std::uint8_t>() != 0;
}

std::string_view MessageValue::text() const {
  require(type_->kind == Kind::kString, "a string");
  const Wire characters = bytes();
  return {reinterpret_cast<const char*>(characters.bytes), characters.size};
}

sweep_guard_core::Time MessageValue::time() const {
  require(type_->kind == Kind::kTime, "a time");
  return sweep_guard_core::Time(std::chrono::seconds(read<std::uint32_t>()) + Duration(read<std::uint32_t>(4)));
}

Duration MessageValue::duration() const {
  require(type_->kind == Kind::kDuration, "a duration");
  return std::chrono::seconds(read<std::int32_t>()) + Duration(read<std::int32_t>(4));
}

size_t MessageValue::size() const {
  require(type_->element != nullptr, "an array");
  return type_->length != 0 ? type_->length : read<std::uint32_t>();
}

size_t MessageValue::firstElement() const { return at_ + (type_->length != 0 ? 0 : sizeof(std::uint32_t)); }

std::vector<MessageValue> MessageValue::elements() const {
  require(type_->kind == Kind::kArray, "an array");
  if (size() > kMaxElements) refuseContent("more than a million elements");
  std::vector<MessageValue> elements;
  elements.reserve(size());
  size_t at = firstElement();
  while (elements.size() < size()) {
    elements.push_back({*type_->element, *name_, message_, at});
    at = endOf(*type_->element, message_, at);
  }
  return elements;
}

Wire MessageValue::bytes() const {
  require(type_->element != nullptr && type_->element->fixed, "an array of values of a fixed size");
  return {message_.bytes + firstElement(), size() * type_->element->min_size};
}

Positions MessageValue::positions() const {
  const Wire records = bytes();
  auto positions = positionsIn<double>(records, *type_->element);
  if (!positions) positions = positionsIn<float>(records, *type_->element);
  require(positions.has_value(), "an array of positions x, y and z");
  return *std::move(positions);
}

std::vector<Triangle> MessageValue::triangles() const {
  require(type_->kind == Kind::kArray, "an array of triangles");
  const ValueType& content = contentOf(*type_->element);
  if (isIndices(content, 0)) return fans();
  require(isIndices(content, 3) || isIndex(content), "an array of triangles");
  const Wire indices = bytes();
  if (indices.size % sizeof(Triangle) != 0) refuseContent("a number of indices that is not a multiple of 3");
  std::vector<Triangle> triangles(indices.size / sizeof(Triangle));
  const std::uint8_t* bytes = indices.bytes;
  for (Triangle& triangle : triangles) {
    triangle = numberAt<Triangle>(bytes);
    bytes += sizeof triangle;
  }
  return triangles;
}

std::vector<Triangle> MessageValue::fans() const {
  std::vector<Triangle> triangles;
  triangles.reserve(size());
  size_t at = firstElement();
  const auto next = [&] {
    at += sizeof(std::uint32_t);
    return numberAt<std::uint32_t>(message_.bytes + at - sizeof(std::uint32_t));
  };
  for (size_t polygons = size(); polygons > 0; --polygons) {
    const std::uint32_t corners = next();
    if (corners < 3) refuseContent("a polygon of less than 3 corners");
    Triangle triangle = {next(), 0, next()};
    for (std::uint32_t i = 2; i < corners; ++i) {
      triangle = {triangle[0], triangle[2], next()};
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace sweep_guard_ros
