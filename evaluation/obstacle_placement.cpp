#include "evaluation/obstacle_placement.h"

#include <algorithm>

#include "evaluation/first_contact.h"
#include "evaluation/random.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;

namespace {

constexpr Duration kHistoryBefore = std::chrono::seconds(1);
constexpr Duration kBefore = std::chrono::seconds(4);
constexpr Duration kUntouchedBefore = std::chrono::seconds(2);
constexpr Duration kAfter = std::chrono::seconds(4);
constexpr Duration kUntouchedAfter = std::chrono::seconds(2);  // makes a warning at the end of a near miss false
constexpr Duration kHalfVelocityWindow = std::chrono::milliseconds(25);
constexpr double kRestSpeed = 0.01;       // [m/s] below, the tool rests
constexpr double kMaxGap = 0.1;           // [m] of a near miss
constexpr int kTriesForPlacement = 1000;  // for each placement, on average

/// Returns the velocity of the tip [m/s].
Eigen::Vector3d tipVelocityAt(const RecordedMotion& motion, Time time) {
  const Eigen::Vector3d displacement_W =
      motion.at(time + kHalfVelocityWindow).translation() - motion.at(time - kHalfVelocityWindow).translation();
  return displacement_W / sweep_guard_core::toSeconds(2 * kHalfVelocityWindow);
}

/// Returns a moment of the motion that has room for an episode.
std::optional<Time> randomMoment(const RecordedMotion& motion, Duration after, Random& random) {
  const Duration length = motion.poses().back().stamp - motion.poses().front().stamp;
  const Time time = motion.poses().front().stamp +
                    sweep_guard_core::fromSeconds(random.uniform(0.0, sweep_guard_core::toSeconds(length)));
  if (!motion.isContinuous(time - kBefore - kHistoryBefore, time + after + kHalfVelocityWindow)) return std::nullopt;
  if (tipVelocityAt(motion, time).norm() < kRestSpeed) return std::nullopt;
  return time;
}

/// Returns the tool point that is farthest along a direction.
Eigen::Vector3d frontPoint(const ConvexShape& tool, const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& direction_W) {
  const Eigen::Vector3d direction_T = X_WT.linear().transpose() * direction_W;
  const Eigen::Vector3d front = tool.frontSupport(direction_T);
  const Eigen::Vector3d rear = tool.rearSupport(direction_T);
  return X_WT * (direction_T.dot(front) >= direction_T.dot(rear) ? front : rear);
}

/// Returns an obstacle in a tangent plane of the tool at a moment that faces its velocity, shifted at random.
SquareObstacle randomObstacle(const RecordedMotion& motion, const ConvexShape& tool, Time moment, bool touched,
                              Random& random) {
  const double max_tilt = (touched ? 60.0 : 90.0) * kPi / 180.0;  // of the normal against the velocity
  const double max_shift = touched ? 0.9 : 2.0;                   // in the plane of the obstacle [half sides]
  const Eigen::Matrix3d R_WV = random.frameWithZ(tipVelocityAt(motion, moment).normalized());
  const double angle = random.uniform(0.0, max_tilt);
  const Eigen::Vector3d normal_W = R_WV * Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  SquareObstacle obstacle;
  obstacle.half_side = random.uniform(0.05, 0.15);
  obstacle.X_WS.linear() = random.frameWithZ(normal_W);
  const double x = random.uniform(-max_shift, max_shift) * obstacle.half_side;
  const double y = random.uniform(-max_shift, max_shift) * obstacle.half_side;
  const double z = random.uniform(0.0, touched ? 0.0 : kMaxGap);
  obstacle.X_WS.translation() =
      frontPoint(tool, motion.at(moment), normal_W) + obstacle.X_WS.linear() * Eigen::Vector3d(x, y, z);
  return obstacle;
}

std::optional<ObstaclePlacement> tryContact(const RecordedMotion& motion, const ConvexShape& tool, Random& random) {
  const std::optional<Time> moment = randomMoment(motion, Duration(0), random);
  if (!moment) return std::nullopt;
  const SquareObstacle obstacle = randomObstacle(motion, tool, *moment, /*touched=*/true, random);
  const Time begin = *moment - kBefore;
  const std::optional<Time> contact = firstContact(motion, tool, obstacle, begin, *moment);
  if (!contact || *contact < begin + kUntouchedBefore) return std::nullopt;
  return ObstaclePlacement{obstacle, begin, *contact, contact};
}

std::optional<ObstaclePlacement> tryMiss(const RecordedMotion& motion, const ConvexShape& tool, Random& random) {
  const std::optional<Time> moment = randomMoment(motion, kAfter + kUntouchedAfter, random);
  if (!moment) return std::nullopt;
  const SquareObstacle obstacle = randomObstacle(motion, tool, *moment, /*touched=*/false, random);
  if (!intersects(tool, motion.at(*moment), obstacle, kMaxGap)) return std::nullopt;
  const Time begin = *moment - kBefore;
  const Time end = *moment + kAfter;
  if (firstContact(motion, tool, obstacle, begin, end + kUntouchedAfter)) return std::nullopt;
  return ObstaclePlacement{obstacle, begin, end, std::nullopt};
}

}  // namespace

std::vector<ObstaclePlacement> placeObstacles(const RecordedMotion& motion, const ConvexShape& tool, size_t count,
                                              std::uint64_t seed) {
  Random random(seed);
  std::vector<ObstaclePlacement> placements;
  for (size_t tries = kTriesForPlacement * count; placements.size() < count && tries > 0; --tries) {
    const bool to_contact = placements.size() % 2 == 0;
    const std::optional<ObstaclePlacement> placement =
        to_contact ? tryContact(motion, tool, random) : tryMiss(motion, tool, random);
    if (placement) placements.push_back(*placement);
  }
  std::sort(placements.begin(), placements.end(),
            [](const ObstaclePlacement& a, const ObstaclePlacement& b) { return a.begin < b.begin; });
  return placements;
}

}  // namespace sweep_guard_evaluation
