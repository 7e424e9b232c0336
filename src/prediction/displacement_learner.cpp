#include "prediction/displacement_learner.h"

namespace sweep_guard_core {

template <typename Space, int N>
void DisplacementLearner<Space, N>::observe(const MotionTracker<Space>& tracker,
                                            const Regressors<Space, N>& regressors) {
  using Step = typename MotionTracker<Space>::Step;
  newest_ = regressors;
  if (tracker.step() == Step::kBegins) targets_.clear();
  if (tracker.step() == Step::kCorrects) targets_.correctNewest(tracker.newest(), newest_);
  if (tracker.step() != Step::kContinues) return;
  const double period = learned_->share * toSeconds(tracker.period());
  targets_.add(tracker.newest(), newest_, [&](const auto& then, size_t i, const Vector& moved) {
    for (size_t group = 0; group < learned_->groups.size(); ++group) {
      const auto first = static_cast<Eigen::Index>(group) * Space::kAxes;
      learned_->groups[group][i].learn(then.template middleRows<Space::kAxes>(first),
                                       moved.template segment<Space::kAxes>(first), period,
                                       expectedWeights(learned_->groups[group], i));
    }
  });
}

template <typename Space, int N>
typename DisplacementLearner<Space, N>::Weights DisplacementLearner<Space, N>::expectedWeights(
    const Regressions& regressions, size_t horizon) {
  if (horizon == 0) return Regression::constantVelocity(kLearnedHorizons[0]);
  return kLearnedHorizons[horizon] / kLearnedHorizons[horizon - 1] * regressions[horizon - 1].weights();
}

template <typename Space, int N>
typename Space::Vector DisplacementLearner<Space, N>::displacementIn(double ahead) const {
  Vector displacement;
  for (size_t group = 0; group < learned_->groups.size(); ++group) {
    const auto first = static_cast<Eigen::Index>(group) * Space::kAxes;
    const auto weights = interpolateOverHorizons<Weights>(
        ahead, [&](size_t i) { return learned_->groups[group][i].weights() / kLearnedHorizons[i]; });
    displacement.template segment<Space::kAxes>(first) =
        ahead * newest_.template middleRows<Space::kAxes>(first) * weights;
  }
  return displacement;
}

template class DisplacementLearner<PoseSpace, kRegressors>;
template class DisplacementLearner<JointSpace, kRegressors>;
template class DisplacementLearner<PoseSpace, kCommandRegressors>;
template class DisplacementLearner<JointSpace, kCommandRegressors>;

}  // namespace sweep_guard_core
