#pragma once

#include <string>

#include "ros/parameters/parameters.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Where the poses of a frame come from.
struct PoseSource {
  std::string name = "tool pose";   ///< for people
  std::string topic = "tool_pose";  ///< of geometry_msgs/PoseStamped
  ToolSource source = ToolSource::kTopic;
  std::string fixed_frame;
  std::string frame;                     ///< in tf
  sweep_guard_core::Duration silence{};  ///< after which stamps may go back
};

}  // namespace sweep_guard_ros
