#pragma once

#include <optional>
#include <string>

namespace sweep_guard_ros {

/// Returns the numeric address of a host, as roscpp takes it: IPv4 unless ROS_IPV6 is on. Never waits: a name is resolved
/// in the background, and its address is kept. Forgets known addresses once there are 64 names. Any thread.
/// @returns empty while the address is not known: ask again
std::optional<std::string> hostAddress(const std::string& host);

}  // namespace sweep_guard_ros
