#include "evaluation/first_contact.h"

#include <algorithm>

#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::Duration;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

namespace {

/// Returns a lower bound on the distance [m] between tool and obstacle; 0 in contact.
class Clearance {
 public:
  Clearance(const ConvexShape& tool, const SquareObstacle& obstacle) : tool_(tool), obstacle_(obstacle) {}

  double at(const Eigen::Isometry3d& X_WT) {
    const double distance = (X_WT.translation() - obstacle_.X_WS.translation()).norm();
    const double bound = distance - tool_.boundingRadius() - std::sqrt(2.0) * obstacle_.half_side;
    if (bound > kContactTolerance) return last_ = bound;
    last_ = std::max(2.0 * last_, kContactTolerance);
    while (intersects(tool_, X_WT, obstacle_, last_)) {
      if (last_ == kContactTolerance) return 0.0;
      last_ = std::max(0.5 * last_, kContactTolerance);
    }
    return last_;
  }

 private:
  const ConvexShape& tool_;
  const SquareObstacle& obstacle_;
  double last_ = 1.0;  // first guess for the next call
};

/// Returns an upper bound on the speed of any tool point [m/s].
double maxSpeed(const StampedPose& from, const StampedPose& to, const ConvexShape& tool) {
  const sweep_guard_core::Motion motion{from.X_WT, to.X_WT};
  const double distance =
      (to.X_WT.translation() - from.X_WT.translation()).norm() + motion.angle() * tool.boundingRadius();
  return distance / sweep_guard_core::toSeconds(to.stamp - from.stamp);
}

/// Returns the earliest time at which a tool point may have moved by `distance` [m], rounded down.
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

}  // namespace

std::optional<Time> firstContact(const RecordedMotion& motion, const ConvexShape& tool, const SquareObstacle& obstacle,
                                 Time from, Time to) {
  Clearance clearance(tool, obstacle);
  for (Time time = from; time <= to;) {
    const double clear = clearance.at(motion.at(time));
    if (clear == 0.0) return time;
    if (time == to) break;
    time = std::clamp(earliestArrival(motion, tool, time, to, clear), time + Duration(1), to);
  }
  return std::nullopt;
}

}  // namespace sweep_guard_evaluation
