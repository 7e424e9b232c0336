#include "prediction/polynomial_extrapolator.h"

#include <algorithm>

namespace sweep_guard_core {

PolynomialExtrapolator::PolynomialExtrapolator(const PredictorOptions& options)
    : degree_(options.degree),
      window_(options.window),
      fit_({*std::max_element(options.degree.begin(), options.degree.end()), options.window,
            options.forgetting_factor}) {}

void PolynomialExtrapolator::observe(const PoseTracker& tracker) {
  follow(fit_, tracker);
  PolynomialFit::Degrees degrees = degree_;
  if (fit_.span() < window_ / 2) {
    for (int& degree : degrees) degree = std::min(degree, 1);
  }
  curve_ = fit_.curve(degrees);
  newest_ = tracker.newest().stamp;
  coordinates_ = tracker.coordinates();
}

Vector6d PolynomialExtrapolator::displacementIn(double ahead) const {
  return curve_.at(newest_ + fromSeconds(ahead)) - coordinates_;
}

}  // namespace sweep_guard_core
