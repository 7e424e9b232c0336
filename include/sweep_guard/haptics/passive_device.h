#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "sweep_guard/haptics/force_renderer.h"
#include "sweep_guard/haptics/passivity_controller.h"

namespace sweep_guard_core {

/// How a hand moves at most.
struct HandLimits {
  double max_speed = 0.5;                ///< of the hand along any axis [m/s], > 0
  double max_acceleration = 50.0;        ///< [m/s^2], > 0
  double max_turn_rate = 5.0;            ///< about all axes together [rad/s], > 0
  double max_turn_acceleration = 500.0;  ///< about all axes together [rad/s^2], > 0
};

/// Returns by how much [rad] the integral of the turn rate over an interval may differ from the rotation vector between
/// the orientations at its ends: turns do not commute, and a hand that goes around a cone turns although it ends as it
/// began. The rotation vector r follows r' = w - r x w / 2 + ... [Bortz 1971]. To first order the difference is the
/// area between the path of r and its chord: at most length^2 / (2 pi), and at most rate * acceleration * interval^3 /
/// 12, because w turns no faster than the acceleration allows. The terms that follow are bounded by a factor of 1 +
/// length / 2: checked by random motions, not proven. Where the hand may have made a full turn, the bound is the
/// longest path that it can have turned, plus the angle.
/// @param angle     of the rotation between the ends, in [0, pi] [rad]
/// @param interval  >= 0 [s]
double coningBound(double angle, double interval, const HandLimits& limits);

/// Keeps a device passive in each of its axes, three of translation and three of rotation, with one PassivityController
/// each. The turn about an axis is what the hand may have turned about it: see coningBound(). One thread at a time. It
/// allocates nothing.
class PassiveDevice {
 public:
  /// @throws InvalidInput  if an option is NaN or out of range
  PassiveDevice(const ForceOptions& force, const HandLimits& limits);

  /// A hand in a frame F that does not move.
  struct Hand {
    Eigen::Isometry3d X_FH = Eigen::Isometry3d::Identity();
    Eigen::Matrix3d R_FD = Eigen::Matrix3d::Identity();  ///< axes of the device
    double scale = 1.0;                                  ///< displacement in F per displacement of the device [-], > 0
    Timestamps timestamps;
  };

  /// Observes where the hand is. One that was observed before, by its stamp, changes nothing.
  void observe(const Hand& hand, const Instant& now);

  /// Returns what to send: in each axis the wanted effort, or the nearest one that is passive.
  DeviceWrench limit(const DeviceWrench& wanted, SteadyTime now);

  double energy() const;     ///< the largest that an axis of translation has given [J]; negative: all took more
  double tolerance() const;  ///< of an axis of translation [J]

  double turnEnergy() const;     ///< the same of the axes of rotation [J]; 0 without torque
  double turnTolerance() const;  ///< of an axis of rotation [J]; 0 without torque

 private:
  bool hasTorque() const { return axes_.size() > kTranslation; }

  static constexpr size_t kTranslation = 3;  // axes
  const HandLimits limits_;
  std::vector<PassivityController> axes_;  // three of translation, then, with torque, three of rotation
  std::optional<Hand> newest_;
  SteadyTime measured_;  // when the hand was there
};

}  // namespace sweep_guard_core
