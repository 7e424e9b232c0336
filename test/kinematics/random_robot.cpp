#include "kinematics/random_robot.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

Eigen::Isometry3d moved(const Eigen::Isometry3d& X, Random& random, double reach) {
  Eigen::Isometry3d X_near = X;
  X_near.linear() = X.linear() * random.turn(random.uniform(0.0, reach));
  X_near.translation() += random.uniform(0.0, reach) * random.direction();
  return X_near;
}

}  // namespace

KinematicTree randomRobot(Random& random, size_t joints, bool branches) {
  std::vector<JointVariable> variables;
  std::vector<TreeLink> links;
  for (size_t i = 0; i < joints; ++i) {
    TreeLink link;
    link.name = "link" + std::to_string(i);
    link.joint = "joint" + std::to_string(i);
    if (i > 0) link.parent = branches ? static_cast<size_t>(random.below(static_cast<int>(i))) : i - 1;
    link.X_PJ = random.pose(random.inBox({0.3, 0.3, 0.3}));
    link.axis_J = random.direction();
    const int kind = i == 0 ? 5 : random.below(6);
    link.type = kind == 0 ? JointType::kFixed : kind == 1 ? JointType::kPrismatic : JointType::kRevolute;
    if (kind == 2) {
      link.variable = static_cast<size_t>(random.below(static_cast<int>(variables.size())));
      link.multiplier = random.uniform(-2.0, 2.0);
      link.offset = random.uniform(-1.0, 1.0);
    } else if (kind != 0) {
      link.variable = variables.size();
      variables.push_back({"joint" + std::to_string(i)});
    }
    links.push_back(link);
  }
  return {variables, links};
}

RobotState randomState(Random& random, const KinematicTree& tree, double reach) {
  RobotState state;
  state.X_WR = random.pose(random.inBox({1.0, 1.0, 1.0}));
  for (size_t i = 0; i < tree.variables().size(); ++i) state.positions.push_back(random.uniform(-reach, reach));
  return state;
}

RobotState randomStateNear(Random& random, const RobotState& state, double reach) {
  RobotState near{moved(state.X_WR, random, reach), state.positions};
  for (double& position : near.positions) position += random.uniform(-reach, reach);
  return near;
}

}  // namespace sweep_guard_core
