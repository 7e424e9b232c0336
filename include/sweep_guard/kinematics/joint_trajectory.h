#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/kinematics/joint_plan.h"

namespace sweep_guard_core {

/// Where the joints are to be at a time of a trajectory.
struct TrajectoryPoint {
  Duration from_start{};                   ///< >= 0
  std::vector<double> positions;           ///< one of each joint [rad or m]
  std::vector<double> velocities = {};     ///< of each joint [rad/s or m/s], or none
  std::vector<double> accelerations = {};  ///< of each joint [rad/s^2 or m/s^2], or none
};

/// A trajectory of named joints, as a controller is asked to follow it.
struct TrajectoryPlan {
  std::vector<std::string> joints;
  std::vector<TrajectoryPoint> points;  ///< their times ascend
};

/// Positions at some times, straight in between.
struct SampledPositions {
  std::vector<Duration> times;                 ///< ascending
  std::vector<std::vector<double>> positions;  ///< at each time [rad or m]
};

constexpr Duration kTrajectoryStep = std::chrono::milliseconds(20);  ///< longest time between two samples

/// Samples a plan at its points, and between them at most kTrajectoryStep apart. Between two points a joint moves as
/// joint_trajectory_controller of ros_controllers moves it: by a quintic polynomial if both have velocities and accelerations, by a
/// cubic one if both have velocities, else straight.
/// @throws InvalidInput if it has no point, is longer than 10 minutes, its times do not ascend, or a point does not have one
///     finite number for each joint
SampledPositions sampled(const TrajectoryPlan& plan);

/// A trajectory under way: where a controller moves the joints of a robot from now on.
class JointTrajectory {
 public:
  /// Begins a plan, whose joints planned() finds in a tree. If its first point comes later than `begin`, the joints go there from
  /// where they are measured, at rest.
  /// @param measured  positions at `begin`, one of each variable [rad or m]
  /// @throws InvalidInput as sampled() and planned()
  JointTrajectory(const KinematicTree& tree, const JointsBesideTree& beside, TrajectoryPlan plan, Time begin,
                  const std::vector<double>& measured);

  /// Returns whether each joint is within 0.05 rad or 0.02 m of where the trajectory has been in the last 0.2 s.
  /// @param measured  positions now, one of each variable [rad or m]
  bool isFollowed(Time now, const std::vector<double>& measured) const;

  /// Predicts the joints of the trajectory after a measured state. By how much they are off goes back to 1/e within 0.1 s. Their
  /// standard deviation is what has gone back by then, and 1e-3 rad or m.
  /// @param measured  positions now, one of each variable [rad or m]
  /// @param[in,out] positions, variances  one of each variable; those of other joints stay
  void predict(Time now, const std::vector<double>& measured, Duration ahead, std::vector<double>& positions,
               std::vector<double>& variances) const;

  /// Returns what is left, to within 1e-3 rad or m: from the positions now to those predicted for the end. Other joints stay.
  SampledPositions rest(Time now, const std::vector<double>& measured) const;

 private:
  struct Joint {
    size_t variable;
    bool continuous;
    double tolerance;  // [rad or m]
  };

  double at(Time time, size_t variable) const;
  double offset(Time now, const std::vector<double>& measured, const Joint& joint) const;

  Time begin_;
  SampledPositions samples_;   // since then; of each variable
  std::vector<Joint> joints_;  // of the trajectory
};

}  // namespace sweep_guard_core
