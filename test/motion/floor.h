#pragma once

#include "sweep_guard/motion/velocity_limiter.h"

namespace sweep_guard_core {

inline const BrakingLimits kLimits{/*deceleration=*/1.0, /*reaction_time=*/0.1, /*standoff=*/0.0, /*tool_radius=*/0.1};

/// Returns what the floor, which faces up, is to a ball of the tool at this gap [m].
inline FacingBall floorAt(double gap, const Eigen::Vector3d& center_W = Eigen::Vector3d::Zero(),
                          double surface_speed = 0.0) {
  return {Eigen::Vector3d::UnitZ(), center_W, gap, surface_speed};
}

inline bool isZero(const Twist& twist_W) { return twist_W == Twist{}; }

}  // namespace sweep_guard_core
