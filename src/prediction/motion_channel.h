#pragma once

#include <memory>
#include <optional>

#include "prediction/commanded_motion.h"
#include "prediction/error_model.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_tracker.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Predicts the motion of a tool or a joint, and the covariance of its errors from those of its own earlier predictions.
template <typename Space>
class MotionChannel {
 public:
  /// @throws InvalidInput if the name of the predictor is unknown
  /// @param learned  shared with other channels; null: it learns alone
  MotionChannel(const PredictorOptions& options, const Space& space,
                std::shared_ptr<LearnedMotion<Space>> learned = nullptr);

  /// Adds what goes to the robot, by the arguments of CommandedMotion::command(). Only `direct` takes it into account.
  template <typename... Command>
  void command(const Command&... command) {
    if (extrapolator_->regressors() == nullptr) return;
    if (!commanded_) commanded_.emplace(tracker_.space(), learned_);
    commanded_->command(command...);
  }

  void observe(const typename Space::Sample& sample);
  void interrupt();  ///< ends the motion: the next sample begins another one

  bool knowsMotion() const { return tracker_.samples() >= 2; }  ///< two samples since the motion began
  const typename Space::Sample& newest() const { return tracker_.newest(); }

  /// Returns the displacement after the newest sample that is predicted, within the limits of the space.
  /// @param ahead  [s], > 0
  typename Space::Vector displacementIn(double ahead) const {
    return usesCommand() ? commanded_->displacementIn(ahead) : displacementMeasured(ahead);
  }
  /// Returns the covariance of its error.
  typename ErrorModel<Space>::Covariance covariance(double ahead) const {
    return usesCommand() ? commanded_->covariance(ahead) : errors_.covariance(ahead);
  }
  /// Returns whether the command predicts them, not the measured motion alone.
  bool usesCommand() const { return commanded_ && commanded_->inUse(); }

 private:
  typename Space::Vector displacementMeasured(double ahead) const {
    return tracker_.space().possible(tracker_.newest(), extrapolator_->displacementIn(ahead), ahead);
  }

  MotionTracker<Space> tracker_;
  Velocity<Space> velocity_;
  std::shared_ptr<LearnedMotion<Space>> learned_;
  std::unique_ptr<Extrapolator<Space>> extrapolator_;
  ErrorModel<Space> errors_;
  std::optional<CommandedMotion<Space>> commanded_;  // empty before the first command
};

/// Returns the options.
/// @throws InvalidInput if one is out of range; not if the name of the predictor is unknown
const PredictorOptions& checked(const PredictorOptions& options);

}  // namespace sweep_guard_core
