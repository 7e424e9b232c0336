#include "sweep_guard/motion/velocity_limiter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sweep_guard_core {
namespace {

// Errors of a closing speed, in commanded speeds of the fastest tool point:
constexpr double kCommandRounding = 1e-11;  // of the command itself
constexpr double kMaxRounding = 1.5e-6;     // of the nearest velocity, between planes that are nearly parallel

constexpr double kWhole = 1.0 - 1e-9;  // of a scale: rounding of the way until rest

}  // namespace

// The fastest point of what is sent goes at most as fast as the ball closes, and as it goes on beside that.
ClosingRow::ClosingRow(const FacingBall& ball, const Twist& command_W, const BrakingLimits& limits)
    : normal_W(ball.normal_W),
      turning(-ball.normal_W.dot(command_W.w_W.cross(ball.center_W))),
      distance(ball.gap - limits.standoff),
      surface_speed(std::max(0.0, ball.surface_speed)) {
  const double per_speed = 0.5 / limits.deceleration;
  const Eigen::Vector3d sliding_W = command_W.v_W - std::min(0.0, normal_W.dot(command_W.v_W)) * normal_W;
  const double turning_on = std::max(0.0, limits.tool_radius * command_W.w_W.norm() - turning);
  const double beside = sliding_W.norm() + normal_W.dot(sliding_W) + turning_on;
  BrakingLimits along_path = limits;
  along_path.reaction_time += beside * per_speed;
  limit = std::max(0.0, stoppingSpeed(distance - surface_speed * beside * per_speed, along_path) - surface_speed);
  turning +=
      arcClosing(ball, command_W.w_W, limits.reaction_time + fastestPoint(command_W, limits.tool_radius) * per_speed);
}

VelocityLimiter::VelocityLimiter(size_t balls) {
  rows_.reserve(balls);
  half_spaces_.reserve(balls + 2);
}

Twist VelocityLimiter::limit(const Twist& command_W, const std::vector<FacingBall>& facing,
                             const UncoveredSurfaces& uncovered, const BrakingLimits& limits) {
  requireUsable(command_W);
  requireUsable(limits);
  requireUsable(uncovered);
  collectRows(command_W, facing, limits);
  const double allowed = allowedSpeed(uncovered, limits);
  const double fastest = fastestPoint(command_W, limits.tool_radius);
  const double exact = kCommandRounding * fastest;
  if (fastest <= allowed && largestScale(command_W.v_W, 1.0, exact) == 1.0) return command_W;

  const Eigen::Vector4d motion = nearest(command_W);
  const double s = motion[3];
  const Twist nearest_W{motion.head<3>(), s * command_W.w_W};
  const double speed = fastestPoint(nearest_W, limits.tool_radius);
  const double tolerance = kMaxRounding * fastest;
  const double scale =
      std::min({largestScale(nearest_W.v_W, s, tolerance), stoppingScale(nearest_W, s, limits, tolerance),
                speed > allowed ? allowed / speed : 1.0});
  return {scale * nearest_W.v_W, scale * nearest_W.w_W};
}

void VelocityLimiter::collectRows(const Twist& command_W, const std::vector<FacingBall>& facing,
                                  const BrakingLimits& limits) {
  rows_.clear();
  for (const FacingBall& ball : facing) {
    requireUsable(ball);
    rows_.emplace_back(ball, command_W, limits);
  }
}

// In units of the commanded speed: y = (v' / |v|, s). As the command and the origin, the nearest point is at most sqrt(2)
// from the origin, so half-spaces that contain all points there are left out.
void VelocityLimiter::collectHalfSpaces(double speed) {
  half_spaces_.clear();
  half_spaces_.push_back({Eigen::Vector4d::UnitW(), 1.0});
  half_spaces_.push_back({-Eigen::Vector4d::UnitW(), 0.0});
  for (const ClosingRow& row : rows_) {
    Eigen::Vector4d gradient;
    gradient << -speed * row.normal_W, row.turning;
    const double length = gradient.stableNorm();
    if (row.limit < std::sqrt(2.0) * length) half_spaces_.push_back({gradient / length, row.limit / length});
  }
}

// Returns v' and s. If there is no nearest point, largestScale() has to do.
Eigen::Vector4d VelocityLimiter::nearest(const Twist& command_W) {
  const double speed = command_W.v_W.stableNorm();
  collectHalfSpaces(speed);
  Eigen::Vector4d target = Eigen::Vector4d::UnitW();
  if (speed > 0.0) target.head<3>() = command_W.v_W / speed;
  const std::optional<NearestPoint> nearest = nearestPoint(target, half_spaces_);
  if (!nearest) return (Eigen::Vector4d() << command_W.v_W, 1.0).finished();
  const double scale = 1.0 / std::max(1.0, nearest->point.head<3>().norm());
  const double s = scale * std::clamp(nearest->point[3], 0.0, 1.0);
  return (Eigen::Vector4d() << scale * speed * nearest->point.head<3>(), s).finished();
}

// Returns the largest share of a motion at which no plane is closed on too fast.
double VelocityLimiter::largestScale(const Eigen::Vector3d& v_W, double s, double tolerance) const {
  double scale = 1.0;
  for (const ClosingRow& row : rows_) {
    const double closing = row.closing(v_W, s);
    if (closing > row.limit + tolerance) scale = std::min(scale, row.limit / closing);
  }
  return scale;
}

// Returns the largest share with which every ball stops in time along the path of a motion, whatever the other planes have made
// of the command: its way until rest at a closing speed c, c (s t + s^2 b / 2), and that of the surface, speed (t + s b), fit into
// the distance.
double VelocityLimiter::stoppingScale(const Twist& twist_W, double s, const BrakingLimits& limits,
                                      double tolerance) const {
  const double braking_time = fastestPoint(twist_W, limits.tool_radius) / limits.deceleration;
  double scale = 1.0;
  for (const ClosingRow& row : rows_) {
    const double closing = row.closing(twist_W.v_W, s) - tolerance;
    if (closing <= 0.0) continue;
    const double distance = std::max(0.0, row.distance - row.surface_speed * limits.reaction_time);
    const double linear = closing * limits.reaction_time + row.surface_speed * braking_time;
    const double root = std::sqrt(linear * linear + 2.0 * closing * braking_time * distance);
    scale = std::min(scale, 2.0 * distance / (linear + root));
  }
  return scale > kWhole ? 1.0 : scale;
}

Twist escapeVelocity(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
                     const BrakingLimits& limits, double escape_speed) {
  requireUsable(command_W);
  requireUsable(limits);
  requireUsable(uncovered);
  for (const FacingBall& ball : facing) requireUsable(ball);
  const double fastest = fastestPoint(command_W, limits.tool_radius);
  const double allowed = std::min(escape_speed, allowedSpeed(uncovered, limits));
  const double scale = fastest > allowed ? allowed / fastest : 1.0;
  const Twist escape_W{scale * command_W.v_W, scale * command_W.w_W};
  const double acceleration = limits.tool_radius * escape_W.w_W.squaredNorm();
  const StopOnPath stop{limits.reaction_time, fastestPoint(escape_W, limits.tool_radius) / limits.deceleration};
  const bool all_grow = std::all_of(facing.begin(), facing.end(), [&](const FacingBall& ball) {
    return opens(ball.surface_speed, closingSpeed(ball, escape_W), acceleration, stop, 1.0);
  });
  return all_grow ? escape_W : Twist{};
}

}  // namespace sweep_guard_core
