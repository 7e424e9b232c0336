#pragma once

#include <ros/message_traits.h>

#include <boost/uuid/detail/md5.hpp>
#include <cstdio>
#include <string>

namespace sweep_guard_ros {

/// Returns the md5 of a message as ROS computes it: from the definition, in which the md5 of each type stands for its name.
inline std::string md5Of(const std::string& definition) {
  boost::uuids::detail::md5 hash;
  hash.process_bytes(definition.data(), definition.size());
  boost::uuids::detail::md5::digest_type digest;
  hash.get_digest(digest);
  std::string hex;
  for (const unsigned int word : digest) {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", word);
    hex += text;
  }
  return hex;
}

/// Returns the md5 by which nodes find out whether they mean the same message.
template <typename Msg>
std::string md5() {
  return ros::message_traits::MD5Sum<Msg>::value();
}

}  // namespace sweep_guard_ros
