#include "ros/input/jump_watch.h"

#include <vector>

namespace sweep_guard_ros {
namespace {

std::vector<sweep_guard_core::JointVariable> jointsOf(const Parameters& parameters) {
  if (!parameters.articulated) return {};
  return parameters.robot->robot.tree.variables();
}

}  // namespace

JumpWatch::JumpWatch(const LiveParameters& live)
    : live_(live), jumps_(live.initial().tool_frame, live.initial().fixed_frame, jointsOf(live.initial())) {}

std::string JumpWatch::jumpTo(const ArticulatedTool::Pose& state) {
  const auto newest = live_.get();  // limits may change
  const sweep_guard_core::PredictorOptions& limits = newest->guard.predictor;
  return jumps_.add({state.stamp, state.X_WT, state.state.positions}, {limits.max_speed, limits.max_turn_rate});
}

}  // namespace sweep_guard_ros
