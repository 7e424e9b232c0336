#pragma once

#include <optional>

#include "evaluation/delayed_guard.h"
#include "evaluation/driven_robot.h"
#include "evaluation/loop_scene.h"

namespace sweep_guard_evaluation {

/// A straight motion at constant speed of the frame M of a surface. At the time `there`, M coincides with W.
struct SurfaceVelocity {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< [m/s]
  sweep_guard_core::Time there;

  Eigen::Isometry3d poseAt(sweep_guard_core::Time time) const;
};

/// What happened between one command and the next.
struct LoopCycle {
  sweep_guard_core::Twist command_W;
  sweep_guard_core::Twist output_W;  ///< what the robot got
  double gap = 0.0;                  ///< between tool and surface at the begin [m]
  double least_gap = 0.0;            ///< at the ends of the steps of the robot [m]
  double standoff_speed = 0.0;       ///< largest closing speed [m/s] in steps that end at the standoff or behind it
  struct Contact {
    double closing_speed;  ///< of tool and surface [m/s]
    double tool_speed;     ///< of the tool alone, towards the surface [m/s]
  };
  std::optional<Contact> contact;  ///< the first one
};

/// A simulated robot with a tool and a surface, with or without a guard before the robot. A copy continues from the
/// same state.
class ClosedLoop {
 public:
  /// @param scene  must outlive this and all copies, of which only one runs at a time
  ClosedLoop(LoopScene& scene, const SurfaceVelocity& surface, const DrivenRobot::Cycle& begin, double standoff);

  void addGuard(const DelayedGuardOptions& options) { guard_.emplace(scene_->tool(), options); }

  /// Runs until the next command.
  LoopCycle run(const sweep_guard_core::Twist& command_W);

  /// Returns what the guard would send, as the robot carries out the command. Then goes on to the robot of the next cycle.
  /// Without a guard that is the command.
  sweep_guard_core::Twist watch(const sweep_guard_core::Twist& command_W, const DrivenRobot::Cycle& next);

  const LoopScene& scene() const { return *scene_; }
  const SimulatedRobot& robot() const { return robot_; }
  Eigen::Isometry3d X_MT() const;

 private:
  sweep_guard_core::Twist guarded(const sweep_guard_core::Twist& command_W);
  LoopCycle::Contact speedsAt(const sweep_guard_core::Separation& apart) const;

  LoopScene* scene_;
  SurfaceVelocity surface_;
  SimulatedRobot robot_;
  sweep_guard_core::Time now_;
  double standoff_;
  std::optional<DelayedGuard> guard_;
};

}  // namespace sweep_guard_evaluation
