#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "black_box/recording_trigger.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Holds all parameters of black_box, checked. loadBlackBoxParameters() defines key, unit, range, default and effect of each;
/// doc/interface.md and config/black_box.yaml are generated from them.
struct BlackBoxParameters {
  std::string guard;  ///< name of the guard's node
  std::filesystem::path folder;
  sweep_guard_core::RecordingTrigger::Options trigger;
  sweep_guard_core::Duration window;
  std::size_t memory;       ///< [bytes] of messages, those that are being written included
  std::uintmax_t quota;     ///< [bytes]
  std::uintmax_t min_free;  ///< [bytes]
  bool proximity;
  bool interaction;
  ParameterReader::Settings settings;    ///< as read
  std::vector<ParameterInfo> described;  ///< always the same keys in the same order
};

/// Reads the private parameters. A missing parameter takes its default. Warns of each parameter that is not read.
/// @throws sweep_guard_core::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of range
BlackBoxParameters loadBlackBoxParameters(const ros::NodeHandle& private_node);

}  // namespace sweep_guard_ros
