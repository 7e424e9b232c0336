#pragma once

// Idea: what goes to a robot is known before the robot has carried it out. The displacement is regressed on the velocities
// of `direct` and on those of the command, over windows of its last 0.2 s. The weights of each horizon learn dead time and
// lag; a distance that stays between what is commanded and measured is no motion. Invariant: the command is in use only
// while it comes, and while the motion within 0.1 s is what it predicted.

#include <array>
#include <memory>
#include <optional>

#include "prediction/displacement_learner.h"
#include "prediction/error_model.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_tracker.h"

namespace sweep_guard_core {

/// Predicts the motion of a tool or a joint from the command that goes to the robot, and the covariance of its errors.
template <typename Space>
class CommandedMotion {
 public:
  using Vector = typename Space::Vector;
  using Sample = typename Space::Sample;

  /// @param learned  not null; not checked
  CommandedMotion(const Space& space, const std::shared_ptr<LearnedMotion<Space>>& learned);

  /// Adds a position that is commanded, in the coordinates of the tracker.
  void command(const Sample& wanted);
  /// Adds a velocity that is commanded, in the coordinates of the tracker [m/s, rad/s].
  void command(Time stamp, const Vector& velocity);

  /// Adds the newest sample of the measured motion.
  /// @param regressors  of the measured motion, there
  /// @param velocity    as Velocity measures it
  /// @param errors      of what is predicted without the command
  void observe(const MotionTracker<Space>& tracker, const Regressors<Space>& regressors, const Vector& velocity,
               const ErrorModel<Space>& errors);

  /// Forgets the commands, and keeps what was learned of the robot.
  void interrupt();

  /// Returns whether the command predicts the motion from the newest sample on: it comes, and within the last second, no three
  /// samples in a row were farther than three standard deviations from what it had predicted, and than
  /// from what is predicted without it.
  bool inUse() const { return in_use_; }

  /// Returns the displacement after the newest sample, within the limits of the space.
  /// @param ahead  [s], > 0
  Vector displacementIn(double ahead) const {
    return commands_.space().possible(newest_, learner_.displacementIn(ahead), ahead);
  }
  /// Returns the covariance of its error.
  typename ErrorModel<Space>::Covariance covariance(double ahead) const { return errors_.covariance(ahead); }

 private:
  void add(const Sample& wanted);
  Vector velocityWithin(const Velocity<Space>& window) const;

  MotionTracker<Space> commands_;
  std::array<Velocity<Space>, kCommandRegressors - kRegressors> windows_;  // the shortest first
  std::optional<Vector> rate_;                                             // commanded; empty: positions are
  DisplacementLearner<Space, kCommandRegressors> learner_;
  ErrorModel<Space> errors_;
  Sample newest_;   // measured
  int misled_ = 0;  // samples in a row
  Time unused_until_;
  bool in_use_ = false;
};

}  // namespace sweep_guard_core
