#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ros/connection/wire.h"
#include "ros/scene/message_definition.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_ros {

/// Reads a value in the bytes of a message whose type is known only from its definition. Refers to both, which outlive
/// it. Every function throws sweep_guard_core::InvalidInput, naming the field, if the value has another type than the
/// function reads.
class MessageValue {
 public:
  /// Checks the whole message, in a time that does not depend on the length of arrays whose elements have a fixed size.
  /// @throws InvalidInput if a length exceeds the message, or if bytes are left over
  MessageValue(const MessageDefinition& definition, Wire message);

  bool has(std::string_view field) const;
  /// @throws InvalidInput naming the field and the type of this value, if it has no such field
  MessageValue operator[](std::string_view field) const;

  double number() const;                        ///< of any number but uint64
  std::int64_t integer() const;                 ///< of any integer but uint64
  bool flag() const;                            ///< of a bool
  std::string_view text() const;                ///< of a string
  sweep_guard_core::Time time() const;          ///< of a time
  sweep_guard_core::Duration duration() const;  ///< of a duration

  /// Returns how many elements an array or bytes a string has.
  size_t size() const;
  /// Returns the elements of an array. For large arrays, the functions below take less time and memory.
  /// @throws InvalidInput if there are more than a million
  std::vector<MessageValue> elements() const;
  /// Returns the bytes of an array whose elements have a fixed size, or of a string.
  Wire bytes() const;
  /// Returns the positions in an array of records of a fixed size with numbers x, y and z, all float64 or all float32.
  std::vector<Eigen::Vector3d> positions() const;
  /// Returns the triangles in an array of uint32, three for each triangle, or of records of which uint32[3] or uint32[]
  /// is the only field. Polygons (uint32[]) become fans around their first corner. Indices are not checked.
  /// @throws InvalidInput if a polygon has less than three corners, or if the number of plain indices is not a multiple
  ///     of 3
  std::vector<sweep_guard_core::Triangle> triangles() const;

 private:
  MessageValue(const ValueType& type, const std::string& name, Wire message, size_t at)
      : type_(&type), name_(&name), message_(message), at_(at) {}

  [[noreturn]] void refuseContent(const char* content) const;
  void require(bool right, const char* wanted) const;
  template <typename Number>
  Number read(size_t offset = 0) const;  // [bytes]
  size_t firstElement() const;
  std::vector<sweep_guard_core::Triangle> fans() const;

  const ValueType* type_;
  const std::string* name_;  // of the field
  Wire message_;
  size_t at_;  // [bytes]
};

}  // namespace sweep_guard_ros
