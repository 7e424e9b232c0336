#pragma once

#include <string>
#include <vector>

#include "camera/depth_surface.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// A depth camera, whose surface is a workpiece.
struct CameraParameters {
  std::string id;                          ///< of the workpiece
  std::string depth;                       ///< topic of the images
  sweep_guard_core::DepthOptions options;  ///< how its images are taken
  sweep_guard_core::Duration timeout{};    ///< an older image makes the warning UNKNOWN
  double self_padding = 0.0;               ///< what is as near to the tool is the tool itself [m]
};

/// Reads the list `cameras`.
/// @throws sweep_guard_core::InvalidInput naming entry, value and range
std::vector<CameraParameters> readCameras(ParameterReader& read);

/// Reads `min_seen`, see WarningLimits.
double readMinSeen(ParameterReader& read, double fallback);

}  // namespace sweep_guard_ros
