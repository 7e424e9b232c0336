#include "sweep_guard/kinematics/jacobian.h"

namespace sweep_guard_core {

void geometricJacobian(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& X_RL, size_t link,
                       Jacobian& J_R) {
  J_R.setZero(6, static_cast<Eigen::Index>(tree.variables().size()));
  const Eigen::Vector3d p_R = poseOf(link, X_RL).translation();
  for (size_t i = link; i != TreeLink::kRoot; i = tree.links()[i].parent) {
    const TreeLink& above = tree.links()[i];
    if (!above.moves()) continue;
    // The joint does not move its own axis: the pose of its link serves for that of the joint.
    const Eigen::Vector3d axis_R = above.multiplier * (X_RL[i].linear() * above.axis_J);
    auto column = J_R.col(static_cast<Eigen::Index>(above.variable));
    if (above.type == JointType::kPrismatic) {
      column.head<3>() += axis_R;
    } else {
      column.head<3>() += axis_R.cross(p_R - X_RL[i].translation());
      column.tail<3>() += axis_R;
    }
  }
}

}  // namespace sweep_guard_core
