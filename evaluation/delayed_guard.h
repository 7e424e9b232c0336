#pragma once

#include <deque>
#include <memory>

#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_evaluation {

struct DelayedGuardOptions {
  sweep_guard_core::MotionGuardOptions motion;
  double reach = 0.3;                                                      ///< of the planes [m], > 0
  sweep_guard_core::Duration pose_delay = std::chrono::milliseconds(10);   ///< until a pose arrives, >= 0
  sweep_guard_core::Duration plane_delay = std::chrono::milliseconds(20);  ///< until its planes arrive, >= pose_delay
};

/// A motion guard that learns of the tool and of the surfaces late. A copy continues from the same state.
class DelayedGuard {
 public:
  DelayedGuard(const sweep_guard_core::Tool& tool, const DelayedGuardOptions& options);

  /// Takes a pose and its planes. They arrive after their delays.
  void measure(const Eigen::Isometry3d& X_WT, const sweep_guard_core::Proximity& proximity, sweep_guard_core::Time now);

  /// @param now  of measure() before
  sweep_guard_core::Twist guard(const sweep_guard_core::Twist& command_W, sweep_guard_core::Duration period,
                                sweep_guard_core::Time now);

  const DelayedGuardOptions& options() const { return options_; }

 private:
  using Planes = std::shared_ptr<const sweep_guard_core::PlaneSet>;

  Planes newest(sweep_guard_core::Time now, sweep_guard_core::Duration delay) const;
  const DelayedGuardOptions options_;
  std::shared_ptr<const sweep_guard_core::ToolBalls> tool_;
  sweep_guard_core::MotionGuard guard_;
  std::deque<Planes> measured_;  // the newest last
};

}  // namespace sweep_guard_evaluation
