#pragma once

#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/publisher.h>
#include <sweep_guard/TrajectoryStatus.h>

#include <atomic>
#include <functional>
#include <future>
#include <string>

#include "common/guarded_by.h"
#include "ros/connection/bounded.h"
#include "ros/process/log_throttle.h"
#include "ros/service/follow_joint_trajectory.h"
#include "ros/service/path_tests.h"
#include "ros/service/service_threads.h"
#include "ros/service/trajectory_goals.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_ros {

/// Watches the trajectory that the robot follows, by the goals and states of an action (`trajectory/action`): tells it to the
/// guard, and tests its rest as `~check_trajectory` does, in the same thread, so that it takes a tenth of a processor at most.
/// Publishes `~trajectory` and `~trajectory_clear`. Does nothing if no action is configured.
class TrajectoryWatch {
 public:
  struct GuardCalls {
    std::function<std::future<sweep_guard_core::PoseWithFrames>()> newest_pose;  ///< see GuardThread
    std::function<void(TrajectoryGoals::Trajectory)> set_trajectory;             ///< for the next prediction; may throw
  };

  /// @param tests  must outlive it, as must the threads
  TrajectoryWatch(const ros::NodeHandle& node, const ros::NodeHandle& private_node, ServiceThreads& threads,
                  PathTests& tests, GuardCalls guard);

  /// Begins a test if one is due. To be called often, by one thread.
  void testIfDue();

  struct Summary {
    sweep_guard::TrajectoryStatus status;  ///< the newest
    bool idle = true;                      ///< no trajectory is under way
    sweep_guard_core::Duration took{};     ///< the newest test
  };
  Summary summary() const;  ///< any thread

 private:
  void onGoal(const FollowJointTrajectoryActionGoal& msg, sweep_guard_core::Time received);
  void onStates(const actionlib_msgs::GoalStatusArray& msg);
  sweep_guard_core::PoseWithFrames newestPose() const;
  TrajectoryGoals::UnderWay underWay();
  void test();
  void testRest(const sweep_guard_core::JointTrajectory& trajectory, sweep_guard::TrajectoryStatus& status);
  void publish(Summary summary, sweep_guard_core::SteadyTime begin);

  ServiceThreads& threads_;
  PathTests& tests_;
  const GuardCalls guard_;
  ros::Publisher status_publisher_;
  ros::Publisher clear_publisher_;
  std::atomic<bool> testing_ = false;
  std::atomic<sweep_guard_core::SteadyTime> due_ = sweep_guard_core::SteadyTime();
  mutable sweep_guard_core::Mutex mutex_;
  TrajectoryGoals goals_ GUARDED_BY(mutex_);
  TrajectoryGoals::Trajectory set_ GUARDED_BY(mutex_);  // in the guard
  Summary summary_ GUARDED_BY(mutex_);
  LogThrottle log_;
  BoundedSubscriber goals_subscriber_;
  BoundedSubscriber states_subscriber_;
};

}  // namespace sweep_guard_ros
