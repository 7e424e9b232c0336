#include "evaluation/first_contact.h"

#include <algorithm>
#include <utility>

#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::Duration;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

namespace {

/// Returns an upper bound on the speed of any tool point [m/s].
double maxSpeed(const StampedPose& from, const StampedPose& to, const ConvexShape& tool) {
  const sweep_guard_core::Motion motion{from.X_WT, to.X_WT};
  const double distance =
      (to.X_WT.translation() - from.X_WT.translation()).norm() + motion.angle() * tool.boundingRadius();
  return distance / sweep_guard_core::toSeconds(to.stamp - from.stamp);
}

}  // namespace

ClearanceAt clearanceFrom(const ConvexShape& tool, const Eigen::Vector3d& center_W, double radius,
                          std::function<bool(const Eigen::Isometry3d&, double)> intersects) {
  const double reach = tool.boundingRadius() + radius;
  return [=, intersects = std::move(intersects), last = 1.0](const Eigen::Isometry3d& X_WT) mutable {
    const double bound = (X_WT.translation() - center_W).norm() - reach;
    if (bound > kContactTolerance) return last = bound;
    last = std::max(2.0 * last, kContactTolerance);
    while (intersects(X_WT, last)) {
      if (last == kContactTolerance) return 0.0;
      last = std::max(0.5 * last, kContactTolerance);
    }
    return last;
  };
}

Time earliestArrival(const RecordedMotion& motion, const ConvexShape& tool, Time from, Time limit, double distance) {
  const std::vector<StampedPose>& poses = motion.poses();
  Time time = from;
  for (size_t i = motion.newestAt(from); time < limit && i + 1 < poses.size(); ++i) {
    const double speed = maxSpeed(poses[i], poses[i + 1], tool);
    const double left = sweep_guard_core::toSeconds(poses[i + 1].stamp - time);
    if (speed * left > distance) {
      return time + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(distance / speed));
    }
    distance -= speed * left;
    time = poses[i + 1].stamp;
  }
  return limit;
}

std::optional<Time> firstContact(const RecordedMotion& motion, const ConvexShape& tool, const ClearanceAt& clearance,
                                 Time from, Time to) {
  for (Time time = from; time <= to;) {
    const double clear = clearance(motion.at(time));
    if (clear == 0.0) return time;
    if (time == to) break;
    time = std::clamp(earliestArrival(motion, tool, time, to, clear), time + Duration(1), to);
  }
  return std::nullopt;
}

std::optional<Time> firstContact(const RecordedMotion& motion, const ConvexShape& tool, const SquareObstacle& obstacle,
                                 Time from, Time to) {
  const auto meets = [&](const Eigen::Isometry3d& X_WT, double margin) {
    return intersects(tool, X_WT, obstacle, margin);
  };
  const double radius = std::sqrt(2.0) * obstacle.half_side;
  return firstContact(motion, tool, clearanceFrom(tool, obstacle.X_WS.translation(), radius, meets), from, to);
}

}  // namespace sweep_guard_evaluation
