#include "sweep_guard/prediction/direct_extrapolator.h"

#include <algorithm>
#include <cmath>

#include "sweep_guard/prediction/interpolation.h"

namespace sweep_guard {
namespace {

constexpr std::array<int, 4> kWindows = {50, 120, 300, 800};  // [ms]
constexpr int kDragged = 1;              // the window whose velocity times its speed is the fifth regressor
constexpr double kFastest = 2.5;         // times the usual speed: no more drag beyond
constexpr double kPriorSpeed = 0.02;     // [m/s]
constexpr double kPriorTurnRate = 0.15;  // [rad/s]

template <size_t... i>
std::array<Carry, sizeof...(i)> makeCarries(double prior_speed, std::index_sequence<i...> /*knots*/) {
  return {Carry(kLearnedAhead[i], prior_speed)...};
}

}  // namespace

DirectExtrapolator::DirectExtrapolator()
    : translation_(makeCarries(kPriorSpeed, std::make_index_sequence<kLearnedAhead.size()>())),
      rotation_(makeCarries(kPriorTurnRate, std::make_index_sequence<kLearnedAhead.size()>())) {
  for (const int milliseconds : kWindows) windows_.emplace_back(std::chrono::milliseconds(milliseconds));
}

void DirectExtrapolator::observe(const MotionTrack& track) {
  measure(track);
  if (track.step() == MotionTrack::Step::kBegins) hindsight_.clear();
  if (track.step() == MotionTrack::Step::kCorrects) hindsight_.correctNewest(track.newest(), velocities_);
  if (track.step() != MotionTrack::Step::kContinues) return;
  const double period = toSeconds(track.period());
  hindsight_.add(track.newest(), velocities_, [&](const Velocities& known, size_t i, const Vector6d& moved) {
    translation_[i].learn(known.topRows<3>(), moved.head<3>(), period);
    rotation_[i].learn(known.bottomRows<3>(), moved.tail<3>(), period);
  });
}

void DirectExtrapolator::measure(const MotionTrack& track) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    windows_[i].observe(track);
    velocities_.col(static_cast<int>(i)) = windows_[i].value();
  }
  const Vector6d velocity = velocities_.col(kDragged);
  const Eigen::Array2d square(velocity.head<3>().squaredNorm(), velocity.tail<3>().squaredNorm());
  if (track.step() == MotionTrack::Step::kContinues) speeds_.add(square, toSeconds(track.period()));
  const Eigen::Array2d usual = speeds_.mean();
  for (int part = 0; part < 2; ++part) {
    const double drag = usual[part] > 0.0 ? std::min(std::sqrt(square[part] / usual[part]), kFastest) : 0.0;
    velocities_.col(Carry::kVelocities - 1).segment<3>(3 * part) = drag * velocity.segment<3>(3 * part);
  }
}

Vector6d DirectExtrapolator::displacementIn(double ahead) const {
  Vector6d displacement;
  displacement << carried(translation_, velocities_.topRows<3>(), ahead),
      carried(rotation_, velocities_.bottomRows<3>(), ahead);
  return displacement;
}

Eigen::Vector3d DirectExtrapolator::carried(const Carries& carries, const Carry::Velocities& velocities, double ahead) {
  const Carry::Weights weights =
      overLearnedAhead<Carry::Weights>(ahead, [&](size_t i) { return carries[i].weights() / kLearnedAhead[i]; });
  return ahead * velocities * weights;
}

}  // namespace sweep_guard
