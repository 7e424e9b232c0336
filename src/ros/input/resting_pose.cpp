#include "ros/input/resting_pose.h"

#include <algorithm>

#include "common/frame_name.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr double kRounded = 1e-6;  // [m, rad]
// A tool whose transforms end is taken for one at rest for so long. robot_state_publisher leads by 0.5 s.
constexpr auto kRestingLead = std::chrono::seconds(1);

}  // namespace

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

bool RestingPose::moves(Time newest) {
  const Time at = now().stamp;
  const bool leads = at != Time() && newest > at + kFutureTolerance && newest <= at + kRestingLead;
  stays_ahead_ = leads && stays(at, newest);
  return newest != Time() && !stays_ahead_;
}

bool RestingPose::stays(Time begin, Time end) const {
  const Parameters& initial = live_.initial();
  const auto X_begin = frames_.find(initial.fixed_frame, initial.tool_frame, begin);
  const auto X_end = frames_.find(initial.fixed_frame, initial.tool_frame, end);
  return X_begin && X_end && (X_begin->matrix() - X_end->matrix()).cwiseAbs().maxCoeff() <= kRounded;
}

bool RestingPose::rests(Time stamp) const {
  const std::string& fixed_frame = live_.initial().fixed_frame;
  const std::string& tool_frame = live_.initial().tool_frame;
  if (sweep_guard_core::isSameFrame(fixed_frame, tool_frame))
    throw InvalidInput("tool_frame is fixed_frame, in which it never moves");
  const auto newest = frames_.newest(fixed_frame, tool_frame);
  if (stays_ahead_ && newest && stamp <= *newest) return stays(stamp, *newest);
  if (newest != Time()) return false;
  if (frames_.find(fixed_frame, tool_frame, stamp)) return true;
  throw InvalidInput("the transforms to '" + tool_frame + "' have the stamp 0: stamp each");
}

}  // namespace sweep_guard_ros
