#pragma once

#include <ros/advertise_service_options.h>
#include <ros/node_handle.h>

#include <set>
#include <string>

namespace sweep_guard_ros {

/// Advertises a service, and remembers its name: roscpp keeps no list. Any thread.
ros::ServiceServer advertiseOwn(ros::NodeHandle& node, ros::AdvertiseServiceOptions& options);

/// Returns the resolved names of all services that were ever advertised so in this process. Any thread.
std::set<std::string> ownServices();

}  // namespace sweep_guard_ros
