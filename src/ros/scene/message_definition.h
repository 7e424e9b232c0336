#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// Describes the values of one type in a message: how they lie in the bytes.
struct ValueType {
  /// With the size, this tells each builtin type of ROS; byte is int8, and char is uint8.
  enum class Kind { kSigned, kUnsigned, kFloat, kBool, kTime, kDuration, kString, kArray, kMessage };
  struct Field {
    std::string name;
    const ValueType* type;  ///< not null
  };

  std::string name;  ///< "float64", "geometry_msgs/Point", "geometry_msgs/Point[]"
  Kind kind = Kind::kMessage;
  size_t min_size = 0;                 ///< of a value, at least 1 [bytes]
  bool fixed = false;                  ///< every value takes min_size
  const ValueType* element = nullptr;  ///< of an array; of a string uint8; else null
  size_t length = 0;                   ///< elements of an array `[N]`; 0: each value begins with its length
  std::vector<Field> fields;           ///< of a message, in their order
};

/// Holds the types of a ROS message, read from the text that publishers send in the header of a connection
/// (`message_definition`). Constants and comments are left out.
class MessageDefinition {
 public:
  /// @param datatype  "visualization_msgs/Marker"
  /// @param text      definition of this type, then each type that it needs after a line "MSG: package/Type"
  /// @throws sweep_guard_core::InvalidInput naming the type or line, if the text is longer than 256 KiB or has a line
  ///     that is no field; if a type is missing, defined twice, empty, larger than 1 GiB, part of itself or more than
  ///     32 levels deep, where an array is a level, too; or if its name is longer than kMaxNameLength
  MessageDefinition(const std::string& datatype, const std::string& text);
  MessageDefinition(MessageDefinition&&) = default;  // values point to types: not copied

  const ValueType& type() const { return *type_; }

 private:
  std::map<std::string, ValueType> types_;
  const ValueType* type_;
};

}  // namespace sweep_guard_ros
