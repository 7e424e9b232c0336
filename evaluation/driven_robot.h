#pragma once

#include <vector>

#include "evaluation/recorded_motion.h"
#include "evaluation/simulated_robot.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// Time between two commands.
constexpr sweep_guard_core::Duration kCommandPeriod = std::chrono::milliseconds(10);

/// A robot that a recorded hand drives by its velocity.
struct DrivenRobot {
  struct Cycle {
    sweep_guard_core::Time time;
    sweep_guard_core::Twist command_W;  ///< within the limits of the robot
    SimulatedRobot robot;               ///< before the command
  };
  std::vector<Cycle> cycles;                        ///< ordered by time; none in gaps
  std::vector<sweep_guard_core::StampedPose> path;  ///< of the robot, after each of its steps

  /// Returns the first cycle that is not before a time.
  size_t cycleAt(sweep_guard_core::Time time) const;
};

/// Drives a robot by the velocities of a recorded motion. In each segment without a gap it begins at rest at the first
/// pose. Each velocity is that of the recording until the next command.
DrivenRobot drive(const RecordedMotion& motion, const RobotOptions& options);

/// Returns the motion of a robot to which the poses of a recording go, at their stamps: it follows them at any speed after
/// the dead time and with the lag of the options.
sweep_guard_recording::Recording followed(const sweep_guard_recording::Recording& recording, RobotOptions options);

}  // namespace sweep_guard_evaluation
