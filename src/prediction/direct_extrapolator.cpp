#include "prediction/direct_extrapolator.h"

#include "prediction/interpolation.h"
#include "prediction/profile.h"

namespace sweep_guard_core {
namespace {

constexpr double kPriorSpeed = 0.02;     // [m/s]
constexpr double kPriorTurnRate = 0.15;  // [rad/s]

template <size_t... i>
std::array<DisplacementRegression, sizeof...(i)> makeRegressions(double prior_speed,
                                                                 std::index_sequence<i...> /*horizons*/) {
  return {DisplacementRegression(kLearnedHorizons[i], prior_speed)...};
}

}  // namespace

DirectExtrapolator::DirectExtrapolator(const Profile* profile)
    : translation_(makeRegressions(kPriorSpeed, std::make_index_sequence<kLearnedHorizons.size()>())),
      rotation_(makeRegressions(kPriorTurnRate, std::make_index_sequence<kLearnedHorizons.size()>())) {
  if (profile == nullptr) return;
  regressors_.begin(profile->speeds);
  for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
    translation_[i].begin(profile->translation[i], expectedWeights(translation_, i));
    rotation_[i].begin(profile->rotation[i], expectedWeights(rotation_, i));
  }
}

bool DirectExtrapolator::save(Profile& profile) const {
  profile.speeds = regressors_.speeds();
  for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
    profile.translation[i] = translation_[i].learned();
    profile.rotation[i] = rotation_[i].learned();
  }
  return true;
}

void DirectExtrapolator::observe(const PoseTracker& tracker) {
  regressors_.observe(tracker);
  const MotionRegressors::Values& newest = regressors_.values();
  if (tracker.step() == PoseTracker::Step::kBegins) targets_.clear();
  if (tracker.step() == PoseTracker::Step::kCorrects) targets_.correctNewest(tracker.newest(), newest);
  if (tracker.step() != PoseTracker::Step::kContinues) return;
  const double period = toSeconds(tracker.period());
  targets_.add(tracker.newest(), newest, [&](const MotionRegressors::Values& then, size_t i, const Vector6d& moved) {
    translation_[i].learn({then.topRows<3>(), moved.head<3>(), period}, expectedWeights(translation_, i));
    rotation_[i].learn({then.bottomRows<3>(), moved.tail<3>(), period}, expectedWeights(rotation_, i));
  });
}

DisplacementRegression::Weights DirectExtrapolator::expectedWeights(const Regressions& regressions, size_t horizon) {
  if (horizon == 0) return DisplacementRegression::constantVelocity(kLearnedHorizons[0]);
  return kLearnedHorizons[horizon] / kLearnedHorizons[horizon - 1] * regressions[horizon - 1].weights();
}

Vector6d DirectExtrapolator::displacementIn(double ahead) const {
  Vector6d displacement;
  displacement << displacementIn(ahead, translation_, regressors_.values().topRows<3>()),
      displacementIn(ahead, rotation_, regressors_.values().bottomRows<3>());
  return displacement;
}

Eigen::Vector3d DirectExtrapolator::displacementIn(double ahead, const Regressions& regressions,
                                                   const DisplacementRegression::Velocities& velocities) {
  const auto weights = interpolateOverHorizons<DisplacementRegression::Weights>(
      ahead, [&](size_t i) { return regressions[i].weights() / kLearnedHorizons[i]; });
  return ahead * velocities * weights;
}

}  // namespace sweep_guard_core
