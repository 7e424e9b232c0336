#include "ros/ros_home.h"

#include <cstdlib>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

std::filesystem::path writableFolder(const std::string& instead) {
  const std::filesystem::path folder = "sweep_guard";
  if (const char* const home = std::getenv("ROS_HOME")) return home / folder;
  if (const char* const home = std::getenv("HOME")) return std::filesystem::path(home) / ".ros" / folder;
  throw sweep_guard_core::InvalidInput("ROS_HOME and HOME are not set: set " + instead);
}

}  // namespace sweep_guard_ros
