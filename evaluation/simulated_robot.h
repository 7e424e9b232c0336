#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"

namespace sweep_guard_evaluation {

/// What a robot can carry out, and how late it follows.
struct RobotOptions {
  double max_speed = 0.5;                                                ///< of the origin of the tool frame [m/s], > 0
  double max_turn_rate = 1.0;                                            ///< [rad/s], > 0
  double max_acceleration = 2.0;                                         ///< [m/s^2], > 0
  double max_turn_acceleration = 10.0;                                   ///< [rad/s^2], > 0
  sweep_guard_core::Duration dead_time = std::chrono::milliseconds(20);  ///< >= 0
  sweep_guard_core::Duration lag = std::chrono::milliseconds(30);        ///< time constant of the first order, >= 0
};

/// Returns the velocity nearest to the wanted one, direction by direction, that a robot is able to carry out after `last`.
sweep_guard_core::Twist clipped(const sweep_guard_core::Twist& wanted_W, const sweep_guard_core::Twist& last_W,
                                const RobotOptions& options, double period);

/// A robot that follows velocities after a dead time and with a first-order lag. It moves in steps: during each of them
/// the origin of the tool frame moves straight and the tool turns about one axis, both at constant rate, as in a
/// sweep_guard_core::Motion.
class SimulatedRobot {
 public:
  static constexpr sweep_guard_core::Duration kStep = std::chrono::milliseconds(1);

  /// The robot rests at a pose.
  SimulatedRobot(const Eigen::Isometry3d& X_WT, const RobotOptions& options);

  /// Sends a velocity, which holds until the next one.
  void send(const sweep_guard_core::Twist& command_W) { sent_W_ = command_W; }
  void step();

  Eigen::Isometry3d pose() const;
  const sweep_guard_core::Twist& velocity_W() const { return velocity_W_; }  ///< of the last step

 private:
  Eigen::Vector3d p_WT_;
  Eigen::Quaterniond q_WT_;
  double gain_;  // share of the difference that a step makes up for
  sweep_guard_core::Twist sent_W_;
  std::vector<sweep_guard_core::Twist> delayed_W_;  // one for each step of the dead time
  size_t oldest_ = 0;
  sweep_guard_core::Twist velocity_W_;
};

}  // namespace sweep_guard_evaluation
