#pragma once

#include <optional>
#include <string>

namespace sweep_guard_ros {

/// Returns the numeric address of a host, as roscpp takes it: IPv4 unless ROS_IPV6 is on. Never waits: a name is resolved
/// in the background, once, and its address is kept for as long as the process lives. Any thread.
/// @returns empty while the address is not known: ask again
std::optional<std::string> hostAddress(const std::string& host);

}  // namespace sweep_guard_ros
