#include "ros/input/state_watch.h"

#include "sweep_guard/kinematics/joint_limits.h"

namespace sweep_guard_ros {
namespace {

std::vector<sweep_guard_core::JointVariable> jointsOf(const Parameters& parameters) {
  if (!parameters.articulated) return {};
  return parameters.robot->robot.tree.variables();
}

}  // namespace

StateWatch::StateWatch(const LiveParameters& live, sweep_guard_core::InputRecord& record)
    : live_(live),
      record_(record),
      joints_(jointsOf(live.initial())),
      jumps_(live.initial().tool_frame, live.initial().fixed_frame, joints_) {}

std::string StateWatch::add(const sweep_guard_core::PoseWithFrames& state) {
  const std::vector<double>& positions = state.state.positions;
  repeated_.add(state.X_WT, positions);
  const auto newest = live_.get();  // limits may change
  const sweep_guard_core::PredictorOptions& limits = newest->guard.predictor;
  std::string jump = jumps_.add({state.stamp, state.X_WT, positions}, {limits.max_speed, limits.max_turn_rate});
  std::string odd = jumps_.faster();
  const std::string beyond = contradictedLimits(joints_, positions);
  if (!odd.empty() && !beyond.empty()) odd += "; ";
  odd += beyond;
  if (!odd.empty()) record_.warn(odd);
  return jump;
}

}  // namespace sweep_guard_ros
