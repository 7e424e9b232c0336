#pragma once

#include "prediction/displacement.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Follows the poses of a tool, and tells where its motion is interrupted: by a gap of 0.25 s, of three periods where
/// poses come more slowly, of 1 s in any case, or by a jump that is faster than a tool can be.
class PoseTracker {
 public:
  enum class Step {
    kBegins,     ///< the first pose, or the first after an interruption
    kContinues,  ///< the motion goes on from the pose before
    kCorrects,   ///< the stamp is not later by 0.5 ms: the pose takes the place of the pose before
  };

  /// @param max_speed      [m/s], > 0
  /// @param max_turn_rate  [rad/s], > 0
  PoseTracker(double max_speed, double max_turn_rate) : max_speed_(max_speed), max_turn_rate_(max_turn_rate) {}

  Step add(const StampedPose& pose);

  /// The next pose begins a motion.
  void interrupt() {
    poses_ = 0;
    period_ = Duration::zero();
  }

  Step step() const { return step_; }                    ///< of the newest pose
  double maxSpeed() const { return max_speed_; }         ///< [m/s]
  double maxTurnRate() const { return max_turn_rate_; }  ///< [rad/s]
  int poses() const { return poses_; }                   ///< since the motion began
  const StampedPose& newest() const { return newest_; }  ///< there must be one
  Duration period() const { return period_; }            ///< from the pose before to the newest

  /// The newest pose in numbers that never wrap: translation in W [m], then the turns about the tool's own axes, added
  /// up from pose to pose [rad].
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
