#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "kinematics/random_robot.h"
#include "motion/times.h"
#include "sweep_guard/motion/joint_motion_guard.h"
#include "sweep_guard/motion/moving_tool.h"

namespace sweep_guard_core {

/// An arm among planes, and a command.
struct ArmCase {
  std::shared_ptr<const KinematicTree> tree;
  MotionInputs inputs;
  MeasuredJoints joints;
  JointCommand command;
};

inline Eigen::VectorXd velocitiesOf(const KinematicTree& tree, Random& random, double most) {
  Eigen::VectorXd velocities(static_cast<Eigen::Index>(tree.variables().size()));
  for (double& velocity : velocities) velocity = random.chance(0.3) ? 0.0 : random.uniform(-most, most);
  return velocities;
}

/// Returns the state after the joints have moved at constant speeds for a time [s].
inline RobotState after(RobotState state, const Eigen::VectorXd& velocities, double time) {
  for (size_t i = 0; i < state.positions.size(); ++i)
    state.positions[i] += time * velocities[static_cast<Eigen::Index>(i)];
  return state;
}

/// Returns the velocities 1 ms later of a robot that takes on others. Where it slows down, no point of the tool brakes harder than
/// at a deceleration [m/s^2].
inline Eigen::VectorXd changed(MovingTool& robot, const RobotState& state, const ToolBalls& tool, double deceleration,
                               const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  robot.place(state, tool, from);
  const double before = robot.fastest();
  robot.place(state, tool, to);
  if (robot.fastest() >= before) return to;
  robot.place(state, tool, to - from);
  return from + std::min(1.0, 1e-3 * deceleration / std::max(1e-12, robot.fastest())) * (to - from);
}

/// Returns where the center of a ball is.
inline Eigen::Vector3d centerOf(const ArmCase& arm, const RobotState& state, size_t piece, size_t ball) {
  std::vector<Eigen::Isometry3d> X_RL;
  arm.tree->poses(state.positions, X_RL);
  const auto& links = arm.tree->links();
  const std::string& frame = arm.inputs.tool->frames[piece];
  size_t link = TreeLink::kRoot;
  for (size_t i = 0; i < links.size(); ++i) link = links[i].name == frame ? i : link;
  return state.X_WR * poseOf(link, X_RL) * arm.inputs.tool->pieces[piece][ball].center_T;
}

inline ToolBalls ballsOn(const KinematicTree& tree, Random& random) {
  ToolBalls tool{1, {}, {}};
  for (size_t link = 0; link <= tree.links().size(); ++link) {
    tool.frames.push_back(link == tree.links().size() ? "" : tree.links()[link].name);
    tool.pieces.emplace_back();
    const int count = 1 + random.below(3);
    for (int i = 0; i < count; ++i)
      tool.pieces.back().push_back({random.uniform(0.0, 0.3) * random.direction(), random.uniform(0.0, 0.05)});
  }
  return tool;
}

/// Returns a plane before a piece at a distance from its nearest ball.
inline SeparatingPlane planeBefore(const ArmCase& arm, size_t piece, double gap, Random& random) {
  const Eigen::Vector3d normal_W = random.direction();
  SeparatingPlane plane{piece, normal_W, Eigen::Vector3d::Zero(), gap, 0.0};
  double lowest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < arm.inputs.tool->pieces[piece].size(); ++i)
    lowest = std::min(
        lowest, normal_W.dot(centerOf(arm, arm.joints.state, piece, i)) - arm.inputs.tool->pieces[piece][i].radius);
  plane.point_W = (lowest - gap) * normal_W;
  return plane;
}

/// Returns an arm of seven joints at 1000 ms: revolute and prismatic ones, some fixed, some of which mimic others. Its planes were
/// swept where the joints were measured.
inline ArmCase randomArm(Random& random, int planes, double least_gap = -0.01, double most_gap = 0.3) {
  ArmCase arm;
  arm.tree = std::make_shared<const KinematicTree>(randomRobot(random, 7, random.chance(0.3)));
  arm.joints = {randomState(random, *arm.tree, 2.0), received(1000)};
  arm.command = {velocitiesOf(*arm.tree, random, random.logUniform(0.03, 1.5)), received(1000),
                 std::chrono::milliseconds(10)};
  arm.inputs.tool = std::make_shared<const ToolBalls>(ballsOn(*arm.tree, random));
  PlaneSet set{received(1000), at(1150).stamp, true, 1, {}, {}, arm.joints.state.X_WR, {}, arm.joints.state.positions};
  for (const JointVariable& joint : arm.tree->variables()) set.joints.push_back(joint.name);
  const auto pieces = static_cast<int>(arm.inputs.tool->pieces.size());
  for (int i = 0; i < planes; ++i) {
    const double gap = random.uniform(least_gap, most_gap);
    set.planes.push_back(planeBefore(arm, static_cast<size_t>(random.below(pieces)), gap, random));
    if (random.chance(0.3)) set.planes.back().surface_speed = random.uniform(-0.1, 0.1);
  }
  arm.inputs.planes = std::make_shared<const PlaneSet>(set);
  arm.inputs.warning = MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(1000).steady};
  return arm;
}

/// Lets a new guard limit the command at 1000 ms.
inline GuardedMotion guardOnce(const ArmCase& arm, const MotionGuardOptions& options = {}) {
  return JointMotionGuard(options, arm.tree).guard(arm.inputs, arm.joints, arm.command, at(1000));
}

/// Returns a copy of the planes, which takes their place.
inline PlaneSet& editable(ArmCase& arm) {
  auto copy = std::make_shared<PlaneSet>(*arm.inputs.planes);
  arm.inputs.planes = copy;
  return *copy;
}

}  // namespace sweep_guard_core
