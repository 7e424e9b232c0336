#pragma once

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/service.h>

#include <string>

namespace sweep_guard_ros {

/// Returns whether the nodelet manager of a test answers within 20 s.
inline bool awaitManager() {
  const ros::Duration patience(20.0);
  return ros::service::waitForService("/manager/load_nodelet", patience) &&
         ros::service::waitForService("/manager/unload_nodelet", patience);
}

inline bool loadGuard(const std::string& name) {
  nodelet::NodeletLoad call;
  call.request.name = name;
  call.request.type = "sweep_guard/SweepGuardNodelet";
  return ros::service::call("/manager/load_nodelet", call) && call.response.success;
}

inline bool unloadGuard(const std::string& name) {
  nodelet::NodeletUnload call;
  call.request.name = name;
  return ros::service::call("/manager/unload_nodelet", call) && call.response.success;
}

}  // namespace sweep_guard_ros
