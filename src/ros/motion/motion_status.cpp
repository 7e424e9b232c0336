#include "ros/motion/motion_status.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::MotionStatus;
using sweep_guard_core::GuardedMotion;
using sweep_guard_core::Moved;
using sweep_guard_core::Permission;
using sweep_guard_core::printable;

// Length of the difference of two unit vectors: the arrow turns by a degree.
constexpr double kTurned = 0.0175;

bool turned(const geometry_msgs::Vector3& a, const geometry_msgs::Vector3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) > kTurned;
}

MotionStatus emptyStatus() {
  MotionStatus status;
  status.gap = std::numeric_limits<double>::infinity();
  status.planes_age = -1.0;
  return status;
}

std::int8_t codeOf(const GuardedMotion& motion) {
  if (motion.decision.cause == sweep_guard_core::PermissionCause::kOldCommand) return MotionStatus::INVALID;
  if (motion.decision.permission == Permission::kStop) return MotionStatus::HALT_FOR_COLLISION;
  if (motion.scale >= 1.0 && !motion.limiting) return MotionStatus::NO_WARNING;
  const bool halts = !(motion.sent_speed > 0.0) && motion.commanded_speed > 0.0;
  return halts ? MotionStatus::HALT_FOR_COLLISION : MotionStatus::DECELERATE_FOR_COLLISION;
}

std::string nearestText(const MotionStatus& status) {
  if (status.mesh_id.empty()) return "a surface that no plane stands for, as one beyond the guard's proximity/reach";
  char gap[32];
  std::snprintf(gap, sizeof gap, "%.1f mm %s", 1e3 * std::abs(status.gap), status.gap < 0.0 ? "inside" : "in front");
  const std::string link = status.tool_link.empty() ? "" : " of link '" + status.tool_link + "'";
  return "'" + status.mesh_id + "', triangle " + std::to_string(status.triangle) + ", " + gap + link +
         "; back along the arrow";
}

std::string textOf(const MotionStatus& status, const sweep_guard_core::PermissionDecision& decision) {
  if (decision.permission == Permission::kStop) return "stopped: " + status.cause;
  if (decision.permission == Permission::kEscape) {
    if (status.sent_speed > 0.0) return status.cause + ": escapes slowly";
    const std::string away = status.mesh_id.empty() ? "" : " from " + nearestText(status);
    return status.cause + ": stopped, the command does not lead away" + away;
  }
  if (status.code == MotionStatus::NO_WARNING) return "passed on";
  const std::string what = status.code == MotionStatus::HALT_FOR_COLLISION ? "stopped" : "slowed";
  const bool unseen = decision.cause == sweep_guard_core::PermissionCause::kUnseen;
  if (unseen && status.mesh_id.empty()) return what + ": " + status.cause;
  return what + " before " + nearestText(status) + (unseen ? "; " + status.cause : "");
}

// It is not the surfaces that limit the command.
void sayThatItStands(const Moved& lead, MotionStatus& status) {
  const bool waits = !(status.sent_speed > 0.0);
  status.code = waits ? MotionStatus::HALT_FOR_COLLISION : MotionStatus::DECELERATE_FOR_COLLISION;
  if (waits) status.scale = 0.0;
  status.cause = "the tool does not follow";
  char ahead[96];
  std::snprintf(ahead, sizeof ahead, ": the pose sent waits %.1f mm and %.1f degrees ahead of it", 1e3 * lead.distance,
                lead.turn * 180.0 / M_PI);
  status.text = status.cause + ahead;
}

}  // namespace

MotionStatus statusOf(const GuardedMotion& motion, const sweep_guard::Proximity* planes,
                      const std::optional<Moved>& lead) {
  MotionStatus status = emptyStatus();
  status.code = codeOf(motion);
  status.cause = sweep_guard_core::textOf(motion.decision.cause);
  status.scale = motion.commanded_speed == 0.0 ? 1.0 : motion.scale;  // zero in place of zero holds nothing back
  status.commanded_speed = motion.commanded_speed;
  status.sent_speed = motion.sent_speed;
  if (planes != nullptr) status.planes_age = sweep_guard_core::toSeconds(motion.planes_age);
  if (motion.limiting && planes != nullptr) {
    const sweep_guard::SeparatingPlane& plane = planes->planes.at(motion.limiting->plane);
    status.mesh_id = printable(plane.mesh_id);
    status.triangle = plane.triangle;
    status.tool_link = printable(plane.tool_link);
    status.piece = plane.piece;
    status.normal = plane.normal;
    status.gap = motion.limiting->gap;
  }
  status.text = textOf(status, motion.decision);
  if (lead && motion.decision.permission != Permission::kStop) sayThatItStands(*lead, status);
  return status;
}

MotionStatus refusedStatus(const std::string& reason) {
  MotionStatus status = emptyStatus();
  status.code = MotionStatus::INVALID;
  status.cause = "command refused";
  status.text = "stopped: " + reason;
  return status;
}

MotionStatus idleStatus(const sweep_guard_core::PermissionDecision& decision) {
  MotionStatus status = emptyStatus();
  status.cause = sweep_guard_core::textOf(decision.cause);
  status.text = status.cause;
  return status;
}

bool differ(const MotionStatus& a, const MotionStatus& b) {
  return a.code != b.code || a.cause != b.cause || a.scale != b.scale || a.mesh_id != b.mesh_id ||
         a.triangle != b.triangle || a.tool_link != b.tool_link || a.piece != b.piece || a.gap != b.gap ||
         turned(a.normal, b.normal) || (a.code == MotionStatus::INVALID && a.text != b.text);
}

}  // namespace sweep_guard_ros
