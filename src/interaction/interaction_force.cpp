#include "sweep_guard/interaction/interaction_force.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {

Wrench& Wrench::operator+=(const Wrench& other) {
  force_T += other.force_T;
  torque_T += other.torque_T;
  return *this;
}

Wrench interactionForce(const Interpenetration& found, const Eigen::Vector3d& velocity_T, const ForceLaw& law) {
  assert(law.least_area > 0.0);
  const Eigen::Vector3d direction_T = found.area_T / std::max(found.area_T.norm(), law.least_area);
  const double closing = -velocity_T.dot(direction_T);
  const double damped = std::max(0.0, 1.0 + law.damping * closing);
  Wrench wrench;
  wrench.force_T = law.stiffness * found.volume * damped * direction_T;
  wrench.torque_T = found.centroid_T.cross(wrench.force_T);
  return wrench;
}

}  // namespace sweep_guard_core
