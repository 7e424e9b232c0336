#include "prediction/direct_extrapolator.h"

#include <algorithm>
#include <cmath>

#include "prediction/interpolation.h"

namespace sweep_guard_core {
namespace {

constexpr std::array<int, 4> kWindows = {50, 120, 300, 800};  // [ms]
constexpr int kScaled = 1;               // index of the window whose velocity times its speed is the fifth regressor
constexpr double kMaxScale = 2.5;        // largest speed that counts, relative to the mean speed
constexpr double kPriorSpeed = 0.02;     // [m/s]
constexpr double kPriorTurnRate = 0.15;  // [rad/s]

template <size_t... i>
std::array<DisplacementRegression, sizeof...(i)> makeRegressions(double prior_speed,
                                                                 std::index_sequence<i...> /*horizons*/) {
  return {DisplacementRegression(kLearnedHorizons[i], prior_speed)...};
}

}  // namespace

DirectExtrapolator::DirectExtrapolator()
    : translation_(makeRegressions(kPriorSpeed, std::make_index_sequence<kLearnedHorizons.size()>())),
      rotation_(makeRegressions(kPriorTurnRate, std::make_index_sequence<kLearnedHorizons.size()>())) {
  for (const int milliseconds : kWindows) windows_.emplace_back(std::chrono::milliseconds(milliseconds));
}

void DirectExtrapolator::observe(const PoseTracker& tracker) {
  measure(tracker);
  if (tracker.step() == PoseTracker::Step::kBegins) targets_.clear();
  if (tracker.step() == PoseTracker::Step::kCorrects) targets_.correctNewest(tracker.newest(), velocities_);
  if (tracker.step() != PoseTracker::Step::kContinues) return;
  const double period = toSeconds(tracker.period());
  targets_.add(tracker.newest(), velocities_, [&](const Velocities& velocities, size_t i, const Vector6d& moved) {
    translation_[i].learn(velocities.topRows<3>(), moved.head<3>(), period);
    rotation_[i].learn(velocities.bottomRows<3>(), moved.tail<3>(), period);
  });
}

void DirectExtrapolator::measure(const PoseTracker& tracker) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    windows_[i].observe(tracker);
    velocities_.col(static_cast<int>(i)) = windows_[i].value();
  }
  const Vector6d velocity = velocities_.col(kScaled);
  const Eigen::Array2d square(velocity.head<3>().squaredNorm(), velocity.tail<3>().squaredNorm());
  if (tracker.step() == PoseTracker::Step::kContinues) speeds_.add(square, toSeconds(tracker.period()));
  const Eigen::Array2d mean = speeds_.mean();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double scale = mean[i] > 0.0 ? std::min(std::sqrt(square[i] / mean[i]), kMaxScale) : 0.0;
    velocities_.col(DisplacementRegression::kVelocities - 1).segment<3>(3 * i) = scale * velocity.segment<3>(3 * i);
  }
}

Vector6d DirectExtrapolator::displacementIn(double ahead) const {
  Vector6d displacement;
  displacement << displacementIn(ahead, translation_, velocities_.topRows<3>()),
      displacementIn(ahead, rotation_, velocities_.bottomRows<3>());
  return displacement;
}

Eigen::Vector3d DirectExtrapolator::displacementIn(double ahead, const Regressions& regressions,
                                                   const DisplacementRegression::Velocities& velocities) {
  const auto weights = interpolateOverHorizons<DisplacementRegression::Weights>(
      ahead, [&](size_t i) { return regressions[i].weights() / kLearnedHorizons[i]; });
  return ahead * velocities * weights;
}

}  // namespace sweep_guard_core
