#include "ros/motion/command_frames.h"

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

Eigen::Isometry3d newestPose(const Frames& frames, const std::string& target, const std::string& source) {
  const std::optional<sweep_guard_core::Time> stamp = frames.newest(target, source);
  const sweep_guard_core::Duration age = now().stamp - stamp.value_or(sweep_guard_core::Time());
  if (stamp && *stamp != sweep_guard_core::Time() && age > kOldestTransform) {
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(age).count();
    throw FrameError("the transform from '" + source + "' to '" + target + "' is " + std::to_string(milliseconds) +
                     " ms old");
  }
  return frames.lookup(target, source, sweep_guard_core::Time());
}

Eigen::Isometry3d CommandFrames::poseOf(const std::string& frame, const std::optional<ToolPose>& tool) const {
  const std::string& named = frame.empty() ? command_frame_ : frame;
  if (named.empty())
    throw FrameError("its header names no frame: set command_frame to the one that the robot takes it in");
  if (named != tool_frame_) return newestPose(frames_, fixed_frame_, named);
  if (!tool) throw FrameError("the command is in the frame of the tool, and there is no tool pose yet");
  return tool->X_WT;
}

}  // namespace sweep_guard_ros
