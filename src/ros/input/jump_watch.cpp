#include "ros/input/jump_watch.h"

#include <vector>

namespace sweep_guard_ros {
namespace {

std::vector<sweep_guard_core::ToolJumps::Joint> jointsOf(const Parameters& parameters) {
  std::vector<sweep_guard_core::ToolJumps::Joint> joints;
  if (!parameters.articulated) return joints;
  const sweep_guard_core::KinematicTree& tree = parameters.robot->robot.tree;
  for (const sweep_guard_core::JointVariable& variable : tree.variables())
    joints.push_back({variable.name, tree.turns(joints.size()), variable.velocity});
  return joints;
}

}  // namespace

JumpWatch::JumpWatch(const LiveParameters& live)
    : live_(live), jumps_(live.initial().tool_frame, live.initial().fixed_frame, jointsOf(live.initial())) {}

std::string JumpWatch::jumpTo(const sweep_guard_core::PoseWithFrames& state) {
  const auto newest = live_.get();  // limits may change
  const sweep_guard_core::PredictorOptions& limits = newest->guard.predictor;
  return jumps_.add({state.stamp, state.X_WT, state.state.positions}, {limits.max_speed, limits.max_turn_rate});
}

}  // namespace sweep_guard_ros
