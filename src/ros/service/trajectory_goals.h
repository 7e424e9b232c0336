#pragma once

#include <actionlib_msgs/GoalStatusArray.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "sweep_guard/common/time.h"
#include "sweep_guard/kinematics/joint_trajectory.h"

namespace sweep_guard_ros {

/// Finds the trajectory under way among the goals of an action: the newest that its server calls ACTIVE. A server that is silent
/// for more than 1 s has none.
class TrajectoryGoals {
 public:
  using Trajectory = std::shared_ptr<const sweep_guard_core::JointTrajectory>;

  struct Goal {
    std::string id;
    Trajectory trajectory;     ///< null: it was refused
    std::string refusal = {};  ///< why
  };

  void add(Goal goal);  ///< keeps the newest 16
  void setStates(const actionlib_msgs::GoalStatusArray& states, sweep_guard_core::SteadyTime received);

  struct UnderWay {
    Trajectory trajectory = nullptr;  ///< null: none is known
    std::string problem = {};         ///< why one may be under way that is not known; empty: none is
  };
  UnderWay underWay(sweep_guard_core::SteadyTime now) const;

 private:
  std::deque<Goal> goals_;  // the newest last
  size_t active_ = 0;       // number of goals
  std::string newest_;      // id of the newest of these
  std::optional<sweep_guard_core::SteadyTime> heard_;
};

}  // namespace sweep_guard_ros
