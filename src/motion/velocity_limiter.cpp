#include "sweep_guard/motion/velocity_limiter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sweep_guard_core {
namespace {

// Errors of a closing speed, in commanded speeds of the fastest tool point:
constexpr double kCommandRounding = 1e-11;  // of the command itself
constexpr double kMaxRounding = 1.5e-6;     // of the nearest velocity, between planes that are nearly parallel

}  // namespace

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
  if (fastest <= allowed && largestScale(command_W.v_W, 1.0, kCommandRounding * fastest) == 1.0) return command_W;

  const Eigen::Vector4d motion = nearest(command_W);
  const Eigen::Vector3d v_W = motion.head<3>();
  const double s = motion[3];
  const double speed = fastestPoint({v_W, s * command_W.w_W}, limits.tool_radius);
  const double scale = std::min(largestScale(v_W, s, kMaxRounding * fastest), speed > allowed ? allowed / speed : 1.0);
  return {scale * v_W, scale * s * command_W.w_W};
}

void VelocityLimiter::collectRows(const Twist& command_W, const std::vector<FacingBall>& facing,
                                  const BrakingLimits& limits) {
  const double acceleration = arcAcceleration(command_W, limits.tool_radius);
  rows_.clear();
  for (const FacingBall& ball : facing) {
    requireUsable(ball);
    const double turning = -ball.normal_W.dot(command_W.w_W.cross(ball.center_W));
    rows_.push_back({ball.normal_W, turning, closingLimit(ball, acceleration, limits)});
  }
}

// In units of the commanded speed: y = (v' / |v|, s). As the command and the origin, the nearest point is at most sqrt(2)
// from the origin, so half-spaces that contain all points there are left out.
void VelocityLimiter::collectHalfSpaces(double speed) {
  half_spaces_.clear();
  half_spaces_.push_back({Eigen::Vector4d::UnitW(), 1.0});
  half_spaces_.push_back({-Eigen::Vector4d::UnitW(), 0.0});
  for (const Row& row : rows_) {
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
  for (const Row& row : rows_) {
    const double closing = row.closing(v_W, s);
    if (closing > row.limit + tolerance) scale = std::min(scale, row.limit / closing);
  }
  return scale;
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
  const bool all_grow = std::all_of(facing.begin(), facing.end(), [&](const FacingBall& ball) {
    return opens(ball.surface_speed, closingSpeed(ball, escape_W), acceleration, limits);
  });
  return all_grow ? escape_W : Twist{};
}

}  // namespace sweep_guard_core
