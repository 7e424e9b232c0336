#pragma once

#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace sweep_guard_fuzz {

using Bytes = std::vector<std::uint8_t>;

template <typename Msg>
Bytes bytesOf(const Msg& msg) {
  Bytes bytes(ros::serialization::serializationLength(msg));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, msg);
  return bytes;
}

/// A connection from a node of this name.
inline boost::shared_ptr<ros::M_string> connectionFrom(const std::string& caller) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["callerid"] = caller;
  return header;
}

}  // namespace sweep_guard_fuzz
