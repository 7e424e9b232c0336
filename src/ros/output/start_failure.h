#pragma once

#include <ros/node_handle.h>

#include <string>

namespace sweep_guard_ros {

/// Says why the guard does not start: as FATAL in the log, and as an ERROR on /diagnostics. A guard that is restarted
/// repeatedly says so each time. Waits up to 2 s until the subscribers of /diagnostics have it.
void reportStartFailure(ros::NodeHandle node, const std::string& name, const std::string& message);

}  // namespace sweep_guard_ros
