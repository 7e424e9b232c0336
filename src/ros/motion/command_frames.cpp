#include "ros/motion/command_frames.h"

#include "common/frame_name.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

Eigen::Isometry3d newestPose(const Frames& frames, const std::string& target, const std::string& source) {
  const NewestPose newest = frames.newestPose(target, source);
  const sweep_guard_core::Duration age = now().stamp - newest.stamp;
  if (newest.stamp != sweep_guard_core::Time() && age > kOldestTransform) {
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(age).count();
    throw FrameError("the transform from '" + source + "' to '" + target + "' is " + std::to_string(milliseconds) +
                     " ms old");
  }
  return newest.X;
}

Eigen::Isometry3d commandFramePose(const Frames& frames, const MotionParameters& parameters, const std::string& frame,
                                   const std::optional<sweep_guard_core::MotionInputs::ToolPose>& tool) {
  const std::string& named = frame.empty() ? parameters.command_frame : frame;
  if (named.empty())
    throw FrameError("its header names no frame: set command_frame to the one that the robot takes it in");
  if (!sweep_guard_core::isSameFrame(named, parameters.tool.frame))
    return newestPose(frames, parameters.tool.fixed_frame, named);
  if (!tool) throw FrameError("the command is in the frame of the tool, and there is no tool pose yet");
  return tool->X_WT;
}

}  // namespace sweep_guard_ros
