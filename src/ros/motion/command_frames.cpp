#include "ros/motion/command_frames.h"

namespace sweep_guard_ros {

Eigen::Isometry3d CommandFrames::poseOf(const std::string& frame, const std::optional<ToolPose>& tool) const {
  const std::string& named = frame.empty() ? command_frame_ : frame;
  if (named != tool_frame_) return frames_.lookup(fixed_frame_, named, sweep_guard_core::Time());
  if (!tool) throw FrameError("the command is in the frame of the tool, and there is no tool pose yet");
  return tool->X_WT;
}

}  // namespace sweep_guard_ros
