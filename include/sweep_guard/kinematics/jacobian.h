#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {

/// Of a link: velocity of its origin, then its angular velocity, both along the axes of the root frame R, per unit speed of
/// each variable. One column per variable: [m/rad or m/m], [rad/rad or rad/m].
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Computes the geometric Jacobian of a link, or of the root, whose Jacobian is 0. Joints that mimic a variable count in its
/// column.
/// @param X_RL             from KinematicTree::poses()
/// @param[out] J_R         overwritten; its buffer is used again
void geometricJacobian(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& X_RL, size_t link,
                       Jacobian& J_R);

}  // namespace sweep_guard_core
