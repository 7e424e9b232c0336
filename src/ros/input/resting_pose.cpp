#include "ros/input/resting_pose.h"

#include <algorithm>

namespace sweep_guard_ros {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::Time;

// Half of the timeout, if that is shorter: a pose that waits for the processor is not stale yet.
bool RestingPose::isDue(const sweep_guard_core::Instant& now) {
  const auto parameters = live_.get();
  const auto period = std::min(parameters->guard.cycle, parameters->limits.pose_timeout / 2);
  const bool waits =
      now.steady - asked_.steady < period && asked_.stamp <= now.stamp && now.stamp - asked_.stamp < period;
  if (waits || now.stamp == Time()) return false;
  asked_ = now;
  return true;
}

bool RestingPose::rests(Time stamp) const {
  const std::string& fixed_frame = live_.initial().fixed_frame;
  const std::string& tool_frame = live_.initial().tool_frame;
  if (fixed_frame == tool_frame) throw InvalidInput("tool_frame is fixed_frame, in which it never moves");
  if (frames_.newest(fixed_frame, tool_frame) != Time()) return false;
  if (frames_.find(fixed_frame, tool_frame, stamp)) return true;
  throw InvalidInput("the transforms to '" + tool_frame + "' have the stamp 0: stamp each");
}

}  // namespace sweep_guard_ros
