#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/motion/pose_source.h"
#include "ros/motion/source_parameters.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/haptics/force_renderer.h"
#include "sweep_guard/haptics/passive_device.h"

namespace sweep_guard_ros {

/// Holds all parameters of haptics, checked. loadHapticsParameters() defines key, unit, range, default and effect of each;
/// doc/haptics.md and config/haptics.yaml are generated from them.
struct HapticsParameters {
  std::string guard;  ///< name of its node
  PoseSource tool;
  JointSource joints;  ///< of a tool that joints move
  std::string device_frame;
  bool device_tells_pose;  ///< on `device_pose`; false: the pose of the tool stands for it
  sweep_guard_core::ForceOptions force;
  sweep_guard_core::HandLimits hand;
  int realtime_priority;                 ///< that the thread that sends asks for; 0: none
  ParameterReader::Settings settings;    ///< as read
  std::vector<ParameterInfo> described;  ///< always the same keys in the same order

  PoseSource device() const {
    return {"pose of the device", "device_pose", ToolSource::kTopic, device_frame, "", tool.silence};
  }
};

/// Reads the private parameters. A missing parameter takes its default. Warns of each parameter that is not read.
/// @throws sweep_guard_core::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of range
HapticsParameters loadHapticsParameters(const ros::NodeHandle& private_node);

}  // namespace sweep_guard_ros
