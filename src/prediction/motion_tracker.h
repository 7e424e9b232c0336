#pragma once

#include "prediction/motion_space.h"
#include "prediction/polynomial_fit.h"

namespace sweep_guard_core {

/// Tracks what moves, a tool or a joint, and detects interruptions of its motion: a gap of 0.25 s, or three periods of
/// slower samples but at most 1 s, or a jump faster than the limits.
template <typename Space>
class MotionTracker {
 public:
  using Sample = typename Space::Sample;
  using Vector = typename Space::Vector;

  enum class Step {
    kBegins,     ///< the first sample, or the first after an interruption
    kContinues,  ///< the motion continues from the previous sample
    kCorrects,   ///< the stamp is later by less than 0.5 ms: the sample replaces the previous one
  };

  explicit MotionTracker(const Space& space) : space_(space) {}

  Step add(const Sample& sample);

  /// Ends the motion: the next sample begins another one.
  void interrupt() {
    samples_ = 0;
    period_ = Duration::zero();
  }

  const Space& space() const { return space_; }
  Step step() const { return step_; }               ///< what the newest sample did
  int samples() const { return samples_; }          ///< number of samples since the motion began
  const Sample& newest() const { return newest_; }  ///< there must be one
  Duration period() const { return period_; }       ///< from the previous sample to the newest

  /// Returns whether there is no sample, or the newest one is three periods old, at least 20 ms: the longest period lately. A
  /// sample that is the only one is so after 1 s.
  bool isSilentAt(Time stamp) const;

  /// Returns coordinates of the newest sample that never wrap. Of a pose: translation in W [m], then the rotations about
  /// the tool's own axes, summed from pose to pose [rad].
  const Vector& coordinates() const { return coordinates_; }

  /// Returns the shortest time over which a velocity is measured, at most 20 ms: half of the longest period lately. Stamps
  /// that come in bursts are closer to each other than the samples were; over 20 ms that averages out.
  Duration leastSpan() const;
  /// Returns the share of a velocity that counts, in [0, 1]: 1 if it was measured over leastSpan().
  double trustIn(Duration span) const;

 private:
  bool gap(Duration period) const;
  void notePeriod(double seconds);

  Space space_;
  int samples_ = 0;
  Step step_ = Step::kBegins;
  Sample newest_{};
  Duration period_{};
  Vector coordinates_ = Vector::Zero();
  double longest_period_ = 0.02;  // lately [s]; before there is one, stamps may be wrong by half of this
};

using PoseTracker = MotionTracker<PoseSpace>;
using JointTracker = MotionTracker<JointSpace>;

/// Adds the newest sample of a tracker to a fit of its coordinates, which restarts after an interruption.
template <typename Space>
void follow(PolynomialFit<Space::kSize>& fit, const MotionTracker<Space>& tracker);

/// Measures a velocity by least squares over the newest part of a motion, or over the newest two samples if they are
/// farther apart. Where samples come in bursts, the part reaches back for at least MotionTracker::leastSpan(); from less than
/// that, the velocity counts in part.
template <typename Space>
class Velocity {
 public:
  using Vector = typename Space::Vector;

  /// @param window  time over which the velocity is measured, > 0
  explicit Velocity(Duration window) : fit_(/*degree=*/1, window, /*forgetting_factor=*/1.0) {}

  void observe(const MotionTracker<Space>& tracker);

  /// Returns the velocity within the limits of the tracker, 0 after the first sample. Of a tool: along the axes of W
  /// [m/s], then about the tool's own axes [rad/s].
  const Vector& value() const { return value_; }

 private:
  PolynomialFit<Space::kSize> fit_;
  Vector value_ = Vector::Zero();
};

}  // namespace sweep_guard_core
