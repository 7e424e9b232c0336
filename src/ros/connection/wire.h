#pragma once

#include <ros/serialization.h>

#include <algorithm>
#include <boost/array.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

/// A serialized message.
struct Wire {
  const std::uint8_t* bytes;
  size_t size;
};

/// Returns the number that begins at an address of any alignment.
template <typename Number>
Number numberAt(const std::uint8_t* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// Walks over the bytes of a message as its generated serializer walks over the fields, but reads the lengths alone. The
/// fields that the serializer passes give the types; their values are never used, and nothing is allocated. Fields of a
/// fixed size are only added up: the sum is compared with the bytes before the next length is read, and at the end.
class WireStream {
 public:
  explicit WireStream(Wire wire) : wire_(wire) {}

  template <typename Field>
  void next(const Field& field) {
    if constexpr (ros::message_traits::IsFixedSize<Field>::value) {
      passed_ += ros::serialization::serializationLength(field);
    } else {
      ros::serialization::Serializer<Field>::template allInOne<WireStream, const Field&>(*this, field);
    }
  }

  template <typename Allocator>
  void next(const std::basic_string<char, std::char_traits<char>, Allocator>& /*text*/) {
    passed_ += length(1);
  }

  // An element without a fixed size holds at least one length, so the loop ends where the bytes end.
  template <typename Element, typename Allocator>
  void next(const std::vector<Element, Allocator>& /*array*/) {
    const size_t smallest = ros::serialization::serializationLength(example<Element>());
    size_t count = length(smallest);
    if constexpr (ros::message_traits::IsFixedSize<Element>::value) {
      passed_ += count * smallest;
    } else {
      const auto& element = example<Element>();
      for (; count > 0; --count) next(element);
    }
  }

  template <typename Element, size_t kSize>
  void next(const boost::array<Element, kSize>& array) {
    if constexpr (ros::message_traits::IsFixedSize<Element>::value) {
      passed_ += ros::serialization::serializationLength(array);
    } else {
      for (const Element& element : array) next(element);
    }
  }

  /// Throws unless the message ends here.
  void end() const {
    if (passed_ > wire_.size) refuse("message is cut off: it takes ", passed_, " bytes and holds ", wire_.size);
    if (passed_ < wire_.size)
      refuse("message is too long for its type: it takes ", passed_, " bytes and holds ", wire_.size);
  }

  /// An empty message, string or number.
  template <typename Type>
  static const Type& example() {
    static const Type kExample{};
    return kExample;
  }

 private:
  // Reads how many elements follow.
  // @param smallest  size of an element [bytes]; 0 counts as 1, because such an element still takes memory
  size_t length(size_t smallest) {
    if (passed_ + sizeof(std::uint32_t) > wire_.size) {
      refuse("message is cut off: it takes at least ", passed_ + sizeof(std::uint32_t), " bytes and holds ",
             wire_.size);
    }
    const auto count = numberAt<std::uint32_t>(wire_.bytes + passed_);
    passed_ += sizeof count;
    const size_t left = wire_.size - passed_;
    if (count > left / std::max<size_t>(smallest, 1)) {
      refuse("message announces ", count, " elements and holds ", left);
    }
    return count;
  }

  [[noreturn]] static void refuse(const char* problem, size_t taken, const char* than, size_t bytes) {
    throw sweep_guard_core::InvalidInput(problem + std::to_string(taken) + than + std::to_string(bytes) + " bytes");
  }

  const Wire wire_;
  size_t passed_ = 0;  // [bytes]; up to the next length it may exceed the message
};

/// Checks that each length in a serialized message fits the bytes that follow. roscpp reserves memory for a length
/// before it checks that, and multiplies lengths in 32 bits.
/// @tparam Msg  any generated message, request or response
/// @throws sweep_guard_core::InvalidInput if a length exceeds the message, or if bytes are left over
template <typename Msg>
void checkLengths(Wire wire) {
  WireStream stream(wire);
  stream.next(WireStream::example<Msg>());
  stream.end();
}

}  // namespace sweep_guard_ros
