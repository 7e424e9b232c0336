#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "prediction/delayed_targets.h"
#include "prediction/extrapolator.h"

namespace sweep_guard_core {

/// Regressions for each of kLearnedHorizons, of each group of axes.
template <typename Space, int N>
struct LearnedRegressions {
  using Regressions = std::vector<DisplacementRegression<Space::kAxes, N>>;  ///< for each of kLearnedHorizons

  /// @param channels  number of those that share it, > 0
  LearnedRegressions(const typename Space::Speeds& prior_speeds, size_t channels)
      : share(1.0 / static_cast<double>(channels)) {
    for (int group = 0; group < Space::kGroups; ++group) {
      Regressions& regressions = groups.emplace_back();
      for (const double ahead : kLearnedHorizons) regressions.emplace_back(ahead, prior_speeds[group]);
    }
  }

  std::vector<Regressions> groups;  ///< Space::kGroups of them
  const double share;               ///< of each channel in the time that is learned from
};

/// What is learned of a motion, from what is measured alone and from a command. Channels may share it: joints that one hand
/// moves.
template <typename Space>
struct LearnedMotion {
  /// @param channels  number of those that share it, > 0
  LearnedMotion(const typename Space::Speeds& prior_speeds, size_t channels)
      : measured(prior_speeds, channels), commanded(prior_speeds, channels) {}

  LearnedRegressions<Space, kRegressors> measured;
  LearnedRegressions<Space, kCommandRegressors> commanded;
};

/// Learns the displacements after regressors, by one DisplacementRegression for each of kLearnedHorizons.
template <typename Space, int N>
class DisplacementLearner {
 public:
  using Vector = typename Space::Vector;

  /// @param learned  not null; not checked
  explicit DisplacementLearner(std::shared_ptr<LearnedRegressions<Space, N>> learned) : learned_(std::move(learned)) {}

  /// Adds the newest sample of a tracker.
  /// @param regressors  there
  void observe(const MotionTracker<Space>& tracker, const Regressors<Space, N>& regressors);

  /// Forgets the samples whose displacements are not known yet, and keeps what was learned.
  void interrupt() { targets_.clear(); }

  /// Predicts the displacement after the newest sample.
  /// @param ahead  [s], > 0
  Vector displacementIn(double ahead) const;

 private:
  using Regression = DisplacementRegression<Space::kAxes, N>;
  using Weights = typename Regression::Weights;
  using Regressions = typename LearnedRegressions<Space, N>::Regressions;

  static Weights expectedWeights(const Regressions& regressions, size_t horizon);

  Regressors<Space, N> newest_ = Regressors<Space, N>::Zero();
  DelayedTargets<Space, Regressors<Space, N>> targets_;
  const std::shared_ptr<LearnedRegressions<Space, N>> learned_;
};

}  // namespace sweep_guard_core
