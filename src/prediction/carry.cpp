#include "sweep_guard/prediction/carry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard {
namespace {

constexpr double kMemory = 20.0;       // [s] of what was learned
constexpr double kErrorMemory = 20.0;  // [s] of how it turned out

using Scalar = Eigen::Matrix<double, 1, 1>;

}  // namespace

void Carry::learn(const Velocities& velocities, const Eigen::Vector3d& moved, double period) {
  const Eigen::Vector3d besides = moved - steady(velocities);
  compare({(besides - velocities * learned_).norm(), besides.norm(), moved.norm()}, period);

  const double fade = std::exp(-period / kMemory);
  squares_ = fade * squares_ + period * moved.squaredNorm();
  weight_ = fade * weight_ + period;
  fit_.forget(fade);
  for (int axis = 0; axis < 3; ++axis) fit_.add(velocities.row(axis).transpose(), Scalar(besides[axis]), period);
  learned_ = fit_.coefficients(kVelocities, prior_);
  blend();
}

void Carry::compare(const std::array<double, 3>& errors, double period) {
  const double fade = std::exp(-period / kErrorMemory);
  for (size_t i = 0; i < errors.size(); ++i) errors_[i] = fade * errors_[i] + (1.0 - fade) * errors[i];
}

// The fourth power lets the best of the three prevail without a jump where another takes over.
void Carry::blend() {
  const double least = std::numeric_limits<double>::min() + *std::min_element(errors_.begin(), errors_.end());
  std::array<double, 3> share{};
  double sum = 0.0;
  for (size_t i = 0; i < share.size(); ++i) sum += share[i] = std::pow(least / std::max(errors_[i], least), 4);
  weights_ = share[0] / sum * learned_ + (share[0] + share[1]) / sum * ahead_ * Weights::Unit(0);
}

double Carry::reach() const {
  return weight_ > 0.0 ? std::sqrt(squares_ / weight_) : std::numeric_limits<double>::infinity();
}

}  // namespace sweep_guard
