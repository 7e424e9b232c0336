#pragma once

#include <array>
#include <memory>
#include <optional>

#include "evaluation/driven_robot.h"
#include "evaluation/loop_guard.h"
#include "evaluation/square_obstacle.h"
#include "sweep_guard/geometry/separation.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_evaluation {

/// A square that rests, or moves straight at constant speed; frame M moves with it, and coincides with W at time 0.
struct LoopSurface {
  SquareObstacle square;
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// Tells exactly whether a tool touches a square: by the volumes that it sweeps, not at samples.
class SweptContact {
 public:
  SweptContact(const sweep_guard_core::ConvexShape& tool, const SquareObstacle& square);

  const std::array<Eigen::Vector3d, 4>& corners() const { return corners_; }
  sweep_guard_core::Separation separationAt(const Eigen::Isometry3d& X_MT) const;

  /// Returns the number of the first step of a path on which the tool may touch the square. Empty: it does not touch.
  /// @param gaps  separationAt() the poses: what is far is not swept
  std::optional<size_t> firstContact(const std::vector<Eigen::Isometry3d>& path_MT, const std::vector<double>& gaps);

 private:
  sweep_guard_core::Tool tool_;
  sweep_guard_core::TriangleMesh mesh_M_;
  std::array<Eigen::Vector3d, 4> corners_;
  std::unique_ptr<sweep_guard_core::Detector> detector_;
};

/// A robot, the guard before it, and a surface. A copy goes on from the same state.
class ClosedLoop {
 public:
  /// What happened between one command and the next.
  struct Cycle {
    sweep_guard_core::Twist output_W;
    double gap = 0.0;                 ///< between tool and surface at the begin [m]
    double least_gap = 0.0;           ///< at the ends of the steps [m]
    double fastest_at_standoff = 0.0; ///< largest closing speed [m/s] of a step that ends at the standoff or behind it
    std::optional<double> contact_speed;  ///< closing speed [m/s] at the first contact, if there is one
  };

  /// @param guard  none: commands go to the robot as they are
  ClosedLoop(SweptContact& contact, const LoopSurface& surface, const SimulatedRobot& robot,
             const LoopGuardOptions* guard, double standoff);

  Cycle run(const sweep_guard_core::Twist& command_W);
  /// Lets the guard look on before the begin: at the robot, and at the command that it carried out.
  /// @param before  how long before the begin; decreasing
  void watch(const SimulatedRobot& robot, const sweep_guard_core::Twist& command_W, sweep_guard_core::Duration before);

  const SimulatedRobot& robot() const { return robot_; }
  Eigen::Isometry3d pose_M() const;
  const std::optional<LoopGuard>& guard() const { return guard_; }

 private:
  void measure(const SimulatedRobot& robot, sweep_guard_core::Duration time);
  Eigen::Vector3d moved(sweep_guard_core::Duration time) const {
    return sweep_guard_core::toSeconds(time) * surface_.velocity_W;
  }
  double closingSpeed(const sweep_guard_core::Separation& apart) const;

  SweptContact* contact_;
  LoopSurface surface_;
  SimulatedRobot robot_;
  std::optional<LoopGuard> guard_;
  double standoff_;
  sweep_guard_core::Duration now_{};
};

}  // namespace sweep_guard_evaluation
