#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "prediction/displacement.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

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

/// The position of a joint at a moment; a turning one counts its turns.
struct StampedPosition {
  Time stamp;
  double position = 0.0;  ///< [rad or m]
};

/// What moves: a joint. Its one coordinate is its position [rad or m].
struct JointSpace {
  using Sample = StampedPosition;
  using Vector = Eigen::Matrix<double, 1, 1>;
  static constexpr int kSize = 1;
  static constexpr int kAxes = 1;
  static constexpr int kGroups = 1;
  static constexpr int kErrors = 1;

  double max_speed;    ///< [rad/s or m/s], > 0
  double prior_speed;  ///< from which on motion counts in full [rad/s or m/s], > 0
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  static Vector displacementOf(const Sample& from, const Sample& to) { return Vector(to.position - from.position); }
  static Sample displacedSample(const Sample& from, const Vector& moved) {
    return {from.stamp, from.position + moved[0]};
  }
  using Speeds = Eigen::Array<double, 1, 1>;
  Speeds priorSpeeds() const { return Speeds(prior_speed); }
  bool exceeds(const Vector& moved, double seconds) const { return std::abs(moved[0]) > max_speed * seconds; }
  Vector limitedTo(const Vector& moved, double seconds) const {
    return Vector(std::clamp(moved[0], -max_speed * seconds, max_speed * seconds));
  }
  /// Stops at the limits; a joint beyond one may stay, but goes no farther.
  Vector possible(const Sample& from, const Vector& moved, double seconds) const {
    const double to = from.position + limitedTo(moved, seconds)[0];
    return Vector(std::clamp(to, std::min(lower, from.position), std::max(upper, from.position)) - from.position);
  }
  static std::array<int, 1> degreesOf(const PredictorOptions& options) {
    return {*std::max_element(options.degree.begin(), options.degree.end())};
  }
};

}  // namespace sweep_guard_core
