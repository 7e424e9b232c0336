#include "sweep_guard/motion/braking.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kMaxSpeed = 1e6;        // of a command [m/s], [rad/s]
constexpr double kUnitTolerance = 1e-6;  // of the length of a normal

bool within(const Eigen::Vector3d& vector, double limit) { return (vector.array().abs() <= limit).all(); }

}  // namespace

Twist atPoint(const Twist& twist_W, const Eigen::Vector3d& to_W) {
  return {twist_W.v_W + twist_W.w_W.cross(to_W), twist_W.w_W};
}

double stoppingSpeed(double distance, const BrakingLimits& limits) {
  if (!(distance > 0.0)) return 0.0;
  const double per_distance = limits.reaction_time / distance;
  return 2.0 / (per_distance + std::sqrt(per_distance * per_distance + 2.0 / (limits.deceleration * distance)));
}

double StopOnPath::share(double way) const {
  return 2.0 * way / (reaction_time + std::sqrt(reaction_time * reaction_time + 2.0 * braking_time * way));
}

double timeUntilClosed(double gap, double closing, double acceleration) {
  const double root = std::sqrt(closing * closing + 2.0 * acceleration * gap);
  if (closing > 0.0) return 2.0 * gap / (closing + root);
  return acceleration > 0.0 ? (root - closing) / acceleration : std::numeric_limits<double>::infinity();
}

bool opens(double surface_speed, double closing, double acceleration, const StopOnPath& stop, double share) {
  const double way = stop.way(share);
  return (closing + 0.5 * acceleration * way) * way + std::max(0.0, surface_speed) * stop.untilRest(share) < 0.0;
}

double closingSpeed(const FacingBall& ball, const Twist& twist_W) {
  return -ball.normal_W.dot(twist_W.v_W + twist_W.w_W.cross(ball.center_W));
}

// Along its circle the ball is at x cos(angle) + y sin(angle) along the normal, which is also how fast, in units of |w|^2, the
// closing speed grows there.
double arcClosing(const FacingBall& ball, const Eigen::Vector3d& w_W, double time) {
  const double turn_rate = w_W.norm();
  if (turn_rate == 0.0) return 0.0;
  const Eigen::Vector3d axis_W = w_W / turn_rate;
  const double x = ball.normal_W.dot(ball.center_W - axis_W.dot(ball.center_W) * axis_W);
  const double y = ball.normal_W.dot(axis_W.cross(ball.center_W));
  const double angle = turn_rate * time;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const bool passes_the_largest = angle >= M_PI || (y > 0.0 && y * cosine < x * sine);
  const double largest = passes_the_largest ? std::hypot(x, y) : std::max({0.0, x, x * cosine + y * sine});
  return 0.5 * turn_rate * turn_rate * largest * time;
}

double fastestPoint(const Twist& twist_W, double tool_radius) {
  return twist_W.v_W.norm() + tool_radius * twist_W.w_W.norm();
}

double allowedSpeed(const UncoveredSurfaces& uncovered, const BrakingLimits& limits) {
  return std::max(0.0, stoppingSpeed(uncovered.distance - limits.standoff, limits) - uncovered.speed);
}

void requireUsable(const Twist& command_W) {
  if (within(command_W.v_W, kMaxSpeed) && within(command_W.w_W, kMaxSpeed)) return;
  throw InvalidInput("commanded velocity refused: each component must be finite and within 1e6");
}

void requireUsable(const BrakingLimits& limits) {
  const auto in = [](double value, double from) { return value >= from && value <= kMaxCoordinate; };
  if (!in(limits.deceleration, 1e-6)) throw InvalidInput("deceleration: must be finite and > 0 m/s^2");
  if (!in(limits.reaction_time, 1e-6)) throw InvalidInput("reaction time: must be finite and > 0 s");
  if (!in(limits.standoff, 0.0)) throw InvalidInput("standoff: must be finite and >= 0 m");
  if (!in(limits.tool_radius, 0.0)) throw InvalidInput("tool radius: must be finite and >= 0 m");
}

void requireUsable(const FacingBall& ball) {
  if (!(std::abs(ball.normal_W.squaredNorm() - 1.0) <= kUnitTolerance)) {
    throw InvalidInput("separating plane refused: its normal is not a unit vector");
  }
  if (!within(ball.center_W, kMaxCoordinate) || !(std::abs(ball.gap) <= kMaxCoordinate)) {
    throw InvalidInput("separating plane refused: its gap is not finite or out of range");
  }
  if (!(std::abs(ball.surface_speed) <= kMaxSpeed)) {
    throw InvalidInput("separating plane refused: the speed of its surface is not finite or out of range");
  }
}

void requireUsable(const UncoveredSurfaces& uncovered) {
  if (std::isnan(uncovered.distance)) throw InvalidInput("distance of the surfaces without a plane: is NaN");
  if (!(uncovered.speed >= 0.0)) throw InvalidInput("speed of the surfaces without a plane: must be >= 0 m/s");
}

}  // namespace sweep_guard_core
