#pragma once

#include <ros/node_handle.h>

#include <string>

namespace sweep_guard_ros {

/// Says why the guard does not start: as FATAL in the log, and as an ERROR on /diagnostics. A guard that is started again
/// and again says so each time. Waits up to 2 s, until those have it that listen to /diagnostics.
void reportStartFailure(ros::NodeHandle node, const std::string& name, const std::string& message);

}  // namespace sweep_guard_ros
