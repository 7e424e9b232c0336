#include "prediction/polynomial_extrapolator.h"

#include <algorithm>

namespace sweep_guard_core {

template <typename Space>
PolynomialExtrapolator<Space>::PolynomialExtrapolator(const PredictorOptions& options)
    : degrees_(Space::degreesOf(options)),
      window_(options.window),
      fit_({*std::max_element(degrees_.begin(), degrees_.end()), options.window, options.forgetting_factor}) {}

template <typename Space>
void PolynomialExtrapolator<Space>::observe(const MotionTracker<Space>& tracker) {
  follow(fit_, tracker);
  typename Fit::Degrees degrees = degrees_;
  if (fit_.span() < window_ / 2) {
    for (int& degree : degrees) degree = std::min(degree, 1);
  }
  curve_ = fit_.curve(degrees);
  newest_ = tracker.newest().stamp;
  coordinates_ = tracker.coordinates();
}

template <typename Space>
typename Space::Vector PolynomialExtrapolator<Space>::displacementIn(double ahead) const {
  return curve_.at(newest_ + fromSeconds(ahead)) - coordinates_;
}

template class PolynomialExtrapolator<PoseSpace>;
template class PolynomialExtrapolator<JointSpace>;

}  // namespace sweep_guard_core
