#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "ros/input/frames.h"
#include "ros/motion/motion_parameters.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_ros {

/// How old a transform may be that a command or a tool pose is placed by. One that never changes has no age.
constexpr sweep_guard_core::Duration kOldestTransform = std::chrono::milliseconds(500);

/// Returns the newest pose of frame `source` in frame `target`. Does not wait.
/// @throws FrameError if there is none, or if it is older than kOldestTransform
Eigen::Isometry3d newestPose(const Frames& frames, const std::string& target, const std::string& source);

/// Places the frames of commands, as tf knows them now. The tool itself is where its newest pose is.
class CommandFrames {
 public:
  using ToolPose = sweep_guard_core::MotionInputs::ToolPose;

  CommandFrames(const Frames& frames, const MotionParameters& parameters)
      : frames_(frames),
        fixed_frame_(parameters.fixed_frame),
        tool_frame_(parameters.tool_frame),
        command_frame_(parameters.command_frame),
        command_point_(parameters.command_point) {}

  /// Returns the pose of a command's frame in the fixed frame. Does not wait.
  /// @param frame  empty: command_frame
  /// @throws FrameError if there is none, or none that is new enough
  Eigen::Isometry3d poseOf(const std::string& frame, const std::optional<ToolPose>& tool) const;

  /// Returns the pose of command_point in the tool frame. Does not wait.
  /// @throws FrameError if there is none
  Eigen::Isometry3d point() const { return newestPose(frames_, tool_frame_, command_point_); }

 private:
  const Frames& frames_;
  const std::string fixed_frame_;
  const std::string tool_frame_;
  const std::string command_frame_;
  const std::string command_point_;
};

}  // namespace sweep_guard_ros
