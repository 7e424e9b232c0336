#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/kinematics/joint_limits.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Returns the displacement of a tool from one pose to another: translation along the axes of W [m], then the rotation
/// vector about the tool's own axes [rad]. The rotation is at most pi, whatever wraps and the signs of quaternions are.
inline Vector6d displacement(const Eigen::Isometry3d& X_WT_from, const Eigen::Isometry3d& X_WT_to) {
  const Eigen::AngleAxisd turn(X_WT_from.linear().transpose() * X_WT_to.linear());
  Vector6d moved;
  moved << X_WT_to.translation() - X_WT_from.translation(), turn.angle() * turn.axis();
  return moved;
}

/// Returns the vector, shortened to `length` if it is longer.
inline Eigen::Vector3d limited(const Eigen::Vector3d& vector, double length) {
  const double norm = vector.norm();
  return norm > length ? Eigen::Vector3d(length / norm * vector) : vector;
}

/// Returns the pose after a displacement.
inline Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WT, const Vector6d& displacement) {
  const Eigen::Vector3d turn = displacement.tail<3>();
  const double angle = turn.norm();
  Eigen::Isometry3d X_WT_to = X_WT;
  X_WT_to.translation() += displacement.head<3>();
  if (angle > 0.0) X_WT_to.linear() *= Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return X_WT_to;
}

/// What moves: the pose of a tool. Its coordinates are those of displacement(): a group of three of translation [m], and
/// one of rotation [rad].
struct PoseSpace {
  using Sample = StampedPose;
  using Vector = Vector6d;
  static constexpr int kSize = 6;  ///< of a Vector
  static constexpr int kAxes = 3;  ///< of a group, which share what is learned
  static constexpr int kGroups = 2;
  static constexpr int kErrors = 3;  ///< kinds of errors: along the motion, across it, in rotation

  double max_speed;                   ///< [m/s], > 0
  double max_turn_rate;               ///< [rad/s], > 0
  std::array<bool, 6> constrained{};  ///< axes along which no motion is predicted

  static Vector displacementOf(const Sample& from, const Sample& to) { return displacement(from.X_WT, to.X_WT); }
  /// Returns a sample displaced by a vector, at the same time.
  static Sample displacedSample(const Sample& from, const Vector& moved) {
    return {from.stamp, displaced(from.X_WT, moved)};
  }
  /// Returns a velocity of one sample as that of another: turning about the axes of the other tool.
  static Vector velocityAs(const Sample& other, const Sample& one, Vector velocity) {
    velocity.tail<3>() = other.X_WT.linear().transpose() * (one.X_WT.linear() * velocity.tail<3>());
    return velocity;
  }
  /// Returns the speeds from which on motion counts in full: of translation [m/s], of rotation [rad/s].
  using Speeds = Eigen::Array2d;  ///< of each group
  static Speeds priorSpeeds() { return {0.02, 0.15}; }
  bool exceeds(const Vector& moved, double seconds) const {
    return moved.head<3>().norm() > max_speed * seconds || moved.tail<3>().norm() > max_turn_rate * seconds;
  }
  Vector limitedTo(const Vector& moved, double seconds) const {
    Vector within;
    within << limited(moved.head<3>(), max_speed * seconds), limited(moved.tail<3>(), max_turn_rate * seconds);
    return within;
  }
  /// Returns the part of a predicted displacement that is possible within a time.
  Vector possible(const Sample& /*from*/, Vector moved, double seconds) const {
    for (int axis = 0; axis < kSize; ++axis) {
      if (constrained[static_cast<size_t>(axis)]) moved[axis] = 0.0;
    }
    return limitedTo(moved, seconds);
  }
  static const std::array<int, 6>& degreesOf(const PredictorOptions& options) { return options.degree; }
};

/// What moves: a joint. Its one coordinate is its position [rad or m].
struct JointSpace {
  using Sample = StampedValue<double>;  ///< position; that of a turning joint counts its turns
  using Vector = Eigen::Matrix<double, 1, 1>;
  static constexpr int kSize = 1;
  static constexpr int kAxes = 1;
  static constexpr int kGroups = 1;
  static constexpr int kErrors = 1;

  double max_speed;    ///< [rad/s or m/s], > 0
  double prior_speed;  ///< from which on motion counts in full [rad/s or m/s], > 0
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  double lower = -kUnbounded;
  double upper = kUnbounded;

  static Vector displacementOf(const Sample& from, const Sample& to) { return Vector(to.value - from.value); }
  static Sample displacedSample(const Sample& from, const Vector& moved) { return {from.stamp, from.value + moved[0]}; }
  static Vector velocityAs(const Sample& /*other*/, const Sample& /*one*/, const Vector& velocity) { return velocity; }
  using Speeds = Eigen::Array<double, 1, 1>;
  Speeds priorSpeeds() const { return Speeds(prior_speed); }
  bool exceeds(const Vector& moved, double seconds) const { return std::abs(moved[0]) > max_speed * seconds; }
  Vector limitedTo(const Vector& moved, double seconds) const {
    return Vector(std::clamp(moved[0], -max_speed * seconds, max_speed * seconds));
  }
  /// Stops at the limits, except at one that the joint contradicts (limitTolerance()): it goes on as if there were none.
  Vector possible(const Sample& from, const Vector& moved, double seconds) const {
    const double to = from.value + limitedTo(moved, seconds)[0];
    const double tolerance = limitTolerance(lower, upper);
    const double least = from.value < lower - tolerance ? -kUnbounded : std::min(lower, from.value);
    const double most = from.value > upper + tolerance ? kUnbounded : std::max(upper, from.value);
    return Vector(std::clamp(to, least, most) - from.value);
  }
  static std::array<int, 1> degreesOf(const PredictorOptions& options) {
    return {*std::max_element(options.degree.begin(), options.degree.end())};
  }
};

}  // namespace sweep_guard_core
