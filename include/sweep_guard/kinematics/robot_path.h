#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_core {

/// The guarded links of a robot. Those that no joint moves apart are one body, with the pieces of all of them.
struct Robot {
  KinematicTree tree;
  std::vector<RobotBody> bodies;
  std::vector<Tool> tools;  ///< of each body, in its frame B
};

/// Returns the robot with these pieces.
/// @param pieces  of each link: pieces in its frame, and its index in the tree; not empty
Robot robotOf(KinematicTree tree, const std::vector<std::pair<size_t, std::vector<ConvexPiece>>>& pieces);

/// A path of a robot from state to state, cut into sweeps in which every body moves nearly as a Motion.
struct RobotPath {
  /// The part of the path that a sweep covers: from and to are fractions of a segment, which joins two states.
  struct Place {
    size_t segment;  ///< counted from 0
    double from;
    double to;
  };
  /// Path of a body B.
  struct BodyPath {
    std::vector<Eigen::Isometry3d> X_WB;   ///< before each sweep, and after the last
    std::vector<double> deviation_bounds;  ///< [m], of each sweep, see PathRequest
  };

  std::vector<Place> places;     ///< of each sweep; none for a single state
  std::vector<BodyPath> bodies;  ///< of each body

  double deviationBound() const;  ///< the largest of all [m]; 0 without a sweep
};

/// Computes the path of all bodies. Between two states, joints and root go straight at constant speed, as RobotMotion says.
/// @param states         at least one (asserted)
/// @param max_deviation  [m], > 0: sweeps are short enough for no body to deviate more, but a segment has at most 1000, and
///     the path at most 8192 if it has no more segments; what is left is in the bounds of the deviation
RobotPath robotPath(const Robot& robot, const std::vector<RobotState>& states, double max_deviation);

}  // namespace sweep_guard_core
