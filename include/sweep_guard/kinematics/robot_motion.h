#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {

/// The state of a robot: where its root R is in the fixed frame W, and the position of each joint variable.
struct RobotState {
  Eigen::Isometry3d X_WR = Eigen::Isometry3d::Identity();  ///< translation [m]
  std::vector<double> positions;                           ///< [rad or m]
};

/// Some links of a tree that move as one body, in the frame of the topmost of them.
struct RobotBody {
  size_t link;    ///< from KinematicTree::bodyOf(); TreeLink::kRoot: the body moves with the root
  double radius;  ///< largest distance [m] between a point of the body and the origin of the link, >= 0
};

/// A motion of a robot between two states: its joints move at constant speed while its root
/// moves straight and turns about one axis at constant rate, as Motion says. It is cut into equal parts, in each of
/// which every body moves nearly straight.
///
/// A point of a body deviates from the straight line between its two ends by at most an eighth of the largest |p''|, where
/// the motion lasts from 0 to 1. With q_i' the speed of joint i and r_j the distance of the point from the axis of joint j,
/// both orders of i and j count:
///
///     |p''| <= sum over i, j of |q_i'| |q_j'| r_max(i, j)    max(i, j): the joint farther from the root
///
/// where r_j is 1 for a prismatic joint, and terms vanish whose joint nearer to the root, or both, are prismatic: only a
/// turn turns the directions of the joints beyond it. The turn of the root counts as another joint before all others, whose
/// origin moves straight.
class RobotMotion {
 public:
  /// @param tree      must outlive it
  /// @param from, to  one position of each variable (asserted), finite
  RobotMotion(const KinematicTree& tree, const std::vector<RobotBody>& bodies, const RobotState& from,
              const RobotState& to);

  /// Returns a bound on the distance [m], at any time, of a point of a body from where it would be if its body moved as
  /// Motion says between the ends of each part, and from where it would be if the point moved straight.
  /// @param parts  number of equal parts, >= 1
  double deviationBound(size_t body, size_t parts) const;
  /// Returns the smallest number of parts in which no body deviates by more than this; at most `most`.
  /// @param max_deviation  [m], > 0
  size_t partsFor(double max_deviation, size_t most) const;

  /// Returns the state at a fraction of the motion, in [0, 1].
  RobotState at(double fraction) const;

 private:
  double deviationInOnePart(const RobotBody& body) const;

  const KinematicTree& tree_;
  RobotState from_;
  RobotState to_;
  std::vector<Eigen::Isometry3d> X_RL_start_;
  std::vector<Eigen::Isometry3d> X_RL_end_;
  std::vector<double> deviations_;  // of each body in one part
};

/// Returns the pose of each body in W.
/// @param[out] X_WB  overwritten; its buffer is used again
void bodyPoses(const KinematicTree& tree, const std::vector<RobotBody>& bodies, const RobotState& state,
               std::vector<Eigen::Isometry3d>& X_WB);

}  // namespace sweep_guard_core
