#include "sweep_guard/kinematics/joint_limits.h"

#include <cassert>

#include "common/number_text.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_core {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;  // [rad]

double excessOf(const JointVariable& joint, double position) {
  return std::max(position - joint.upper, joint.lower - position);
}

bool contradicts(const JointVariable& joint, double position) {
  return !joint.continuous && excessOf(joint, position) > limitTolerance(joint.lower, joint.upper);
}

// Far beyond the limits, and within them in another unit.
std::string doubtOfUnit(const JointVariable& joint, double position) {
  const double unit = joint.turns ? kHalfTurn / 180.0 : 1e-3;
  const double far_beyond = joint.turns ? kHalfTurn : 1.0;
  if (excessOf(joint, position) <= far_beyond || contradicts(joint, unit * position)) return "";
  return joint.turns ? ": degrees?" : ": millimeters?";
}

}  // namespace

std::string contradictedLimits(const std::vector<JointVariable>& joints, const std::vector<double>& positions) {
  assert(joints.size() == positions.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    if (!contradicts(joints[i], positions[i])) continue;
    return "joint '" + printable(joints[i].name) + "' is at " + shortText(positions[i]) + ", beyond its limits " +
           shortText(joints[i].lower) + " to " + shortText(joints[i].upper) + " of the robot description" +
           doubtOfUnit(joints[i], positions[i]);
  }
  return {};
}

}  // namespace sweep_guard_core
