#include "prediction/direct_extrapolator.h"

#include <algorithm>
#include <cmath>

#include "prediction/interpolation.h"

namespace sweep_guard_core {
namespace {

constexpr std::array<int, 4> kWindows = {50, 120, 300, 800};  // [ms]
constexpr int kDragged = 1;              // the window whose velocity times its speed is the fifth regressor
constexpr double kFastest = 2.5;         // times the usual speed: no more drag beyond
constexpr double kPriorSpeed = 0.02;     // [m/s]
constexpr double kPriorTurnRate = 0.15;  // [rad/s]

template <size_t... i>
std::array<DisplacementRegression, sizeof...(i)> makeCarries(double prior_speed, std::index_sequence<i...> /*knots*/) {
  return {DisplacementRegression(kLearnedHorizons[i], prior_speed)...};
}

}  // namespace

DirectExtrapolator::DirectExtrapolator()
    : translation_(makeCarries(kPriorSpeed, std::make_index_sequence<kLearnedHorizons.size()>())),
      rotation_(makeCarries(kPriorTurnRate, std::make_index_sequence<kLearnedHorizons.size()>())) {
  for (const int milliseconds : kWindows) windows_.emplace_back(std::chrono::milliseconds(milliseconds));
}

void DirectExtrapolator::observe(const PoseTracker& tracker) {
  measure(tracker);
  if (tracker.step() == PoseTracker::Step::kBegins) targets_.clear();
  if (tracker.step() == PoseTracker::Step::kCorrects) targets_.correctNewest(tracker.newest(), velocities_);
  if (tracker.step() != PoseTracker::Step::kContinues) return;
  const double period = toSeconds(tracker.period());
  targets_.add(tracker.newest(), velocities_, [&](const Velocities& known, size_t i, const Vector6d& moved) {
    translation_[i].learn(known.topRows<3>(), moved.head<3>(), period);
    rotation_[i].learn(known.bottomRows<3>(), moved.tail<3>(), period);
  });
}

void DirectExtrapolator::measure(const PoseTracker& tracker) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    windows_[i].observe(tracker);
    velocities_.col(static_cast<int>(i)) = windows_[i].value();
  }
  const Vector6d velocity = velocities_.col(kDragged);
  const Eigen::Array2d square(velocity.head<3>().squaredNorm(), velocity.tail<3>().squaredNorm());
  if (tracker.step() == PoseTracker::Step::kContinues) speeds_.add(square, toSeconds(tracker.period()));
  const Eigen::Array2d usual = speeds_.mean();
  for (int part = 0; part < 2; ++part) {
    const double drag = usual[part] > 0.0 ? std::min(std::sqrt(square[part] / usual[part]), kFastest) : 0.0;
    velocities_.col(DisplacementRegression::kVelocities - 1).segment<3>(3 * part) =
        drag * velocity.segment<3>(3 * part);
  }
}

Vector6d DirectExtrapolator::displacementIn(double ahead) const {
  Vector6d displacement;
  displacement << carried(translation_, velocities_.topRows<3>(), ahead),
      carried(rotation_, velocities_.bottomRows<3>(), ahead);
  return displacement;
}

Eigen::Vector3d DirectExtrapolator::carried(const Regressions& carries,
                                            const DisplacementRegression::Velocities& velocities, double ahead) {
  const DisplacementRegression::Weights weights = interpolateOverHorizons<DisplacementRegression::Weights>(
      ahead, [&](size_t i) { return carries[i].weights() / kLearnedHorizons[i]; });
  return ahead * velocities * weights;
}

}  // namespace sweep_guard_core
