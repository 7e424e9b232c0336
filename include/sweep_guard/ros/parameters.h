#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/verdict.h"

namespace sweep_guard_ros {

enum class ToolSource { kTopic, kTf };

/// Every parameter of the node, checked. config/sweep_guard.yaml tells key, unit, range and effect of each.
struct Parameters {
  std::string fixed_frame;
  ToolSource tool_source;
  std::string tool_frame;
  std::shared_ptr<const sweep_guard::Tool> tool;
  std::string tool_story;  ///< what it is and where it comes from, for people
  std::string detector;
  std::string detector_story;  ///< its name, and what gives it OpenGL, for people
  sweep_guard::DetectorOptions detector_options;
  sweep_guard::GuardOptions guard;
  sweep_guard::VerdictLimits limits;
  double marker_rate;     ///< [Hz]
  int realtime_priority;  ///< of the thread that sweeps; 0: none
  size_t max_triangles;
};

/// Reads the private parameters; a missing one takes its default. Warns of each parameter that no one reads.
/// Makes the tool, too: of a robot description, if that is what tool/type asks for.
/// @throws sweep_guard::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of range;
///     naming link and file if the robot description makes no tool
Parameters loadParameters(const ros::NodeHandle& private_node);

}  // namespace sweep_guard_ros
