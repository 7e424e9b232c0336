#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {

/// Returns how far beyond its limits a joint that keeps them may be measured: a thousandth of its range, at least 1e-3
/// [rad or m]. A joint that is farther beyond contradicts the limit.
/// @param lower, upper  the limits [rad or m]; may be infinite
inline double limitTolerance(double lower, double upper) {
  const double range = upper - lower;
  return std::isfinite(range) ? 1e-3 * std::max(1.0, range) : 1e-3;
}

/// Returns which joint contradicts its limits, in words, and whether its position looks like degrees or millimeters; the first
/// that does. Empty: none. Continuous joints have no limits.
/// @param positions  one of each joint [rad or m], finite; not checked
std::string contradictedLimits(const std::vector<JointVariable>& joints, const std::vector<double>& positions);

}  // namespace sweep_guard_core
