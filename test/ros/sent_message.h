#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros/raw_message.h"
#include "ros/scene/message_value.h"

namespace sweep_guard_ros {

using Bytes = std::vector<std::uint8_t>;

inline Wire wireOf(const Bytes& bytes) { return {bytes.data(), bytes.size()}; }

/// A message and its bytes.
struct Sent {
  MessageDefinition definition;
  Bytes bytes;

  MessageValue value() const { return {definition, wireOf(bytes)}; }
};

template <typename Msg>
Sent sent(const Msg& msg) {
  return {{ros::message_traits::datatype<Msg>(), ros::message_traits::definition<Msg>()}, serialized(msg).bytes};
}

// Appends what the generated serializers write.
template <typename... Fields>
Bytes fieldBytes(const Fields&... fields) {
  Bytes bytes;
  const auto append = [&bytes](const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); };
  (append(serialized(fields).bytes), ...);
  return bytes;
}

template <typename... Fields>
Sent sent(const std::string& definition, const Fields&... fields) {
  return {{"a/A", definition}, fieldBytes(fields...)};
}

}  // namespace sweep_guard_ros
