#pragma once

#include <set>
#include <string>
#include <vector>

#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {

/// Names of the joints of a robot description that a tree of the tool's links leaves out.
struct JointsBesideTree {
  /// Move the frame of the tool, or are mimicked by a joint that does. They may be variables of the tree, too.
  std::set<std::string> of_frame;
  std::set<std::string> elsewhere;  ///< move neither the tool's links nor its frame, and mimic no variable of the tree
};

/// Holds positions of named joints, as planners send them.
struct JointPlan {
  std::vector<std::string> joints;
  std::vector<std::vector<double>> points;  ///< of each point: one position of each joint [rad or m]
};

/// Holds what a plan makes of a tree.
struct PlannedPositions {
  std::vector<std::vector<double>> positions;  ///< at each point: of each variable of the tree [rad or m]
  std::string
      remarks;  ///< which joints were passed over, and what was taken although it does not fit exactly; empty: none
};

/// Returns whether a joint is one of the robot description.
bool hasJoint(const KinematicTree& tree, const JointsBesideTree& beside, const std::string& joint);

/// Finds the positions of a tree's variables in a plan of the whole robot. Passes over joints that move neither the tool's
/// links nor its frame. Joints that mimic others are where these put them. A position that is beyond a limit by at most 1e-3
/// of its joint's range is taken as it is; a joint that mimics another may differ by as much. The range of a continuous
/// joint is one turn.
/// @param unnamed  position of each variable whose joint the plan does not name [rad or m]
/// @throws InvalidInput with all objections in one line: joints that the robot description does not have, or that are
///     named twice; points that do not have one position of each joint; positions that are not finite, beyond limits, or
///     not where a joint is put that mimics another; a joint that moves the frame of the tool by more than 1e-6 rad or m
PlannedPositions planned(const KinematicTree& tree, const JointsBesideTree& beside, const std::vector<double>& unnamed,
                         const JointPlan& plan);

}  // namespace sweep_guard_core
