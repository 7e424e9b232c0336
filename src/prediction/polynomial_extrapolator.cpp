#include "sweep_guard/prediction/polynomial_extrapolator.h"

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard {
namespace {

PolynomialFit::Options fitOptions(const PredictorOptions& options) {
  const auto [lowest, highest] = std::minmax_element(options.degree.begin(), options.degree.end());
  if (*lowest < 0 || *highest > PolynomialFit::kHighestDegree) {
    throw InvalidInput("prediction degree " + std::to_string(*lowest < 0 ? *lowest : *highest) +
                       " is out of range: use 0 to " + std::to_string(PolynomialFit::kHighestDegree));
  }
  if (!(options.forgetting_factor > 0.0 && options.forgetting_factor <= 1.0)) {
    throw InvalidInput("forgetting factor " + std::to_string(options.forgetting_factor) +
                       " is out of range: use more than 0, at most 1");
  }
  if (options.window <= Duration::zero()) throw InvalidInput("the observation window must be longer than 0 s");
  return {*highest, options.window, options.forgetting_factor};
}

}  // namespace

PolynomialExtrapolator::PolynomialExtrapolator(const PredictorOptions& options)
    : degree_(options.degree), constrained_(options.constrained), window_(options.window), fit_(fitOptions(options)) {}

void PolynomialExtrapolator::observe(const MotionTrack& track) {
  follow(fit_, track);
  PolynomialFit::Degrees degrees = degree_;
  if (fit_.span() < window_ / 2) {
    for (int& degree : degrees) degree = std::min(degree, 1);
  }
  curve_ = fit_.curve(degrees);
  newest_ = track.newest().stamp;
  coordinates_ = track.coordinates();
}

Vector6d PolynomialExtrapolator::displacementIn(double ahead) const {
  Vector6d displacement = curve_.at(newest_ + fromSeconds(ahead)) - coordinates_;
  for (int axis = 0; axis < 6; ++axis) {
    if (constrained_[static_cast<size_t>(axis)]) displacement[axis] = 0.0;
  }
  return displacement;
}

}  // namespace sweep_guard
