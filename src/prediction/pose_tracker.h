#pragma once

#include "prediction/displacement.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Tracks the poses of a tool and detects interruptions of its motion: a gap of 0.25 s, or three periods of slower
/// poses but at most 1 s, or a jump faster than the limits.
class PoseTracker {
 public:
  enum class Step {
    kBegins,     ///< the first pose, or the first after an interruption
    kContinues,  ///< the motion continues from the previous pose
    kCorrects,   ///< the stamp is later by less than 0.5 ms: the pose replaces the previous one
  };

  /// @param max_speed      [m/s], > 0
  /// @param max_turn_rate  [rad/s], > 0
  PoseTracker(double max_speed, double max_turn_rate) : max_speed_(max_speed), max_turn_rate_(max_turn_rate) {}

  Step add(const StampedPose& pose);

  /// Ends the motion: the next pose begins another one.
  void interrupt() {
    poses_ = 0;
    period_ = Duration::zero();
  }

  Step step() const { return step_; }                    ///< what the newest pose did
  double maxSpeed() const { return max_speed_; }         ///< [m/s]
  double maxTurnRate() const { return max_turn_rate_; }  ///< [rad/s]
  int poses() const { return poses_; }                   ///< number of poses since the motion began
  const StampedPose& newest() const { return newest_; }  ///< there must be one
  Duration period() const { return period_; }            ///< from the previous pose to the newest

  /// Returns coordinates of the newest pose that never wrap: translation in W [m], then the rotations about the tool's
  /// own axes, summed from pose to pose [rad].
  const Vector6d& coordinates() const { return coordinates_; }

 private:
  bool tooFar(const Vector6d& moved, Duration period) const;
  bool gap(Duration period) const;

  double max_speed_;
  double max_turn_rate_;
  int poses_ = 0;
  Step step_ = Step::kBegins;
  StampedPose newest_;
  Duration period_{};
  Vector6d coordinates_ = Vector6d::Zero();
};

}  // namespace sweep_guard_core
