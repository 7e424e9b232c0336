#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "ros/input/frames.h"
#include "ros/motion/motion_parameters.h"

namespace sweep_guard_ros {

/// How old a transform may be that a command or a tool pose is placed by. One that never changes has no age.
constexpr sweep_guard_core::Duration kOldestTransform = std::chrono::milliseconds(500);

/// Returns the newest pose of frame `source` in frame `target`. Does not wait.
/// @throws FrameError if there is none, or if it is older than kOldestTransform
Eigen::Isometry3d newestPose(const Frames& frames, const std::string& target, const std::string& source);

/// Returns the pose of a command's frame in the fixed frame, as tf knows it now. The tool itself is where its newest pose is.
/// Does not wait.
/// @param frame  empty: command_frame
/// @throws FrameError if there is none, or none that is new enough
Eigen::Isometry3d commandFramePose(const Frames& frames, const MotionParameters& parameters, const std::string& frame,
                                   const std::optional<sweep_guard_core::MotionInputs::ToolPose>& tool);

}  // namespace sweep_guard_ros
