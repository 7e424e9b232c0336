#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace sweep_guard_ros {

/// Stands for a serialized message of type Msg, right or wrong. roscpp leaves its header.seq as it is.
template <typename Msg>
struct Raw {
  std::vector<std::uint8_t> bytes;
};

template <typename Msg>
Raw<Msg> serialized(const Msg& msg) {
  Raw<Msg> raw;
  raw.bytes.resize(ros::serialization::serializationLength(msg));
  ros::serialization::OStream stream(raw.bytes.data(), static_cast<std::uint32_t>(raw.bytes.size()));
  ros::serialization::serialize(stream, msg);
  return raw;
}

/// Writes an array's length over what is there.
/// @param from_end  position, counted from the end [bytes]
template <typename Msg>
Raw<Msg> forged(Raw<Msg> raw, size_t from_end, std::uint32_t length) {
  std::memcpy(raw.bytes.data() + raw.bytes.size() - from_end, &length, sizeof(length));
  return raw;
}

}  // namespace sweep_guard_ros

namespace ros::message_traits {

template <typename Msg>
struct MD5Sum<sweep_guard_ros::Raw<Msg>> {
  static const char* value() { return MD5Sum<Msg>::value(); }
  static const char* value(const sweep_guard_ros::Raw<Msg>& /*raw*/) { return value(); }
};
template <typename Msg>
struct DataType<sweep_guard_ros::Raw<Msg>> {
  static const char* value() { return DataType<Msg>::value(); }
  static const char* value(const sweep_guard_ros::Raw<Msg>& /*raw*/) { return value(); }
};
template <typename Msg>
struct Definition<sweep_guard_ros::Raw<Msg>> {
  static const char* value() { return Definition<Msg>::value(); }
  static const char* value(const sweep_guard_ros::Raw<Msg>& /*raw*/) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <typename Msg>
struct Serializer<sweep_guard_ros::Raw<Msg>> {
  template <typename Stream>
  static void write(Stream& stream, const sweep_guard_ros::Raw<Msg>& raw) {
    const auto size = static_cast<std::uint32_t>(raw.bytes.size());
    std::memcpy(stream.advance(size), raw.bytes.data(), size);
  }
  static std::uint32_t serializedLength(const sweep_guard_ros::Raw<Msg>& raw) {
    return static_cast<std::uint32_t>(raw.bytes.size());
  }
};

}  // namespace ros::serialization
