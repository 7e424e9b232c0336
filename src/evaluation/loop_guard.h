#pragma once

#include <deque>
#include <vector>

#include "evaluation/square_obstacle.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/motion_in_flight.h"
#include "sweep_guard/motion/plane_cover.h"
#include "sweep_guard/motion/velocity_limiter.h"

namespace sweep_guard_evaluation {

/// What the guard of a simulated tool knows, and how late.
struct LoopGuardOptions {
  sweep_guard_core::ConvexShape tool = sweep_guard_core::ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);
  sweep_guard_core::BrakingLimits braking;
  double slice = 1.0;
  double reach = 0.3;                                                     ///< of the planes [m], > 0
  sweep_guard_core::Duration pose_delay = std::chrono::milliseconds(10);  ///< until a pose arrives, >= 0
  sweep_guard_core::Duration plane_delay = std::chrono::milliseconds(20);  ///< until its planes arrive, >= pose_delay
  sweep_guard_core::Duration in_flight{};  ///< as MotionInFlight::expectedPose() has it, >= 0
};

class LoopGuard {
 public:
  explicit LoopGuard(const LoopGuardOptions& options);

  /// Measures the tool and the surface.
  /// @param corners_W   of the square
  /// @param velocity_W  of the square [m/s]
  void measure(const Eigen::Isometry3d& X_WT, const std::array<Eigen::Vector3d, 4>& corners_W,
               const Eigen::Vector3d& velocity_W, sweep_guard_core::SteadyTime now);

  sweep_guard_core::Twist limit(const sweep_guard_core::Twist& command_W, sweep_guard_core::SteadyTime now);
  void sent(const sweep_guard_core::Twist& output_W, sweep_guard_core::SteadyTime now) { in_flight_.add(output_W, now); }
  const std::vector<sweep_guard_core::FacingBall>& facing() const { return facing_; }

 Eigen::Isometry3d dbg_pose, dbg_expected;
 private:
  struct Measurement {
    sweep_guard_core::SteadyTime at;
    Eigen::Isometry3d X_WT;
    sweep_guard_core::PlaneCover cover;
  };

  const LoopGuardOptions* options_;
  std::vector<sweep_guard_core::ConvexShape> pieces_T_;
  std::vector<std::vector<sweep_guard_core::ToolBall>> balls_T_;
  std::deque<Measurement> measurements_;
  sweep_guard_core::MotionInFlight in_flight_;
  sweep_guard_core::VelocityLimiter limiter_;
  std::vector<sweep_guard_core::FacingBall> facing_;
};

}  // namespace sweep_guard_evaluation
