#include "prediction/polynomial_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "prediction/motion_space.h"

namespace sweep_guard_core {
namespace {

constexpr int kTerms = kMaxPolynomialDegree + 1;
using Terms = Eigen::Matrix<double, kTerms, 1>;

// Computes Legendre polynomials by Bonnet's recursion.
Terms legendre(double x) {
  Terms p = Terms::Ones();
  p[1] = x;
  for (int k = 1; k + 1 < kTerms; ++k) p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
  return p;
}

Terms legendreSlope(double x) {
  const Terms p = legendre(x);
  Terms slope = Terms::Zero();
  slope[1] = 1.0;
  for (int k = 1; k + 1 < kTerms; ++k) slope[k + 1] = slope[k - 1] + (2 * k + 1) * p[k];
  return slope;
}

}  // namespace

template <int N>
typename PolynomialFit<N>::Values PolynomialFit<N>::Curve::sum(const Values& constant,
                                                               const typename Fit::Regressors& terms) const {
  Values values = constant;
  for (int axis = 0; axis < N; ++axis) {
    const auto degree = static_cast<size_t>(degrees_[static_cast<size_t>(axis)]);
    const typename Fit::Coefficients& coefficients = by_degree_[degree];
    values[axis] += coefficients.col(axis).dot(terms.head(coefficients.rows()));
  }
  return values;
}

template <int N>
typename PolynomialFit<N>::Values PolynomialFit<N>::Curve::at(Time stamp) const {
  return sum(origin_, legendre(abscissa(stamp)));
}

template <int N>
typename PolynomialFit<N>::Values PolynomialFit<N>::Curve::slopeAt(Time stamp) const {
  return sum(Values::Zero(), legendreSlope(abscissa(stamp))) / half_width_;
}

template <int N>
PolynomialFit<N>::PolynomialFit(int degree, Duration window, double forgetting_factor)
    : degree_(degree), window_(window), forgetting_factor_(forgetting_factor), samples_(64) {
  assert(degree >= 0 && degree <= kMaxPolynomialDegree && window > Duration::zero());
  assert(forgetting_factor > 0.0 && forgetting_factor <= 1.0);
}

template <int N>
void PolynomialFit<N>::add(Time stamp, const Values& values, Duration least_span) {
  assert(samples_.empty() || stamp > samples_.back().stamp);
  if (samples_.full()) samples_.set_capacity(2 * samples_.capacity());
  samples_.push_back({stamp, values});
  fit_.forget(forgetting_factor_);
  include(samples_.back());
  dropOld(least_span);
  const Time middle = samples_.front().stamp + span() / 2;
  if (std::abs(toSeconds(middle - middle_)) > half_width_ / 4.0 ||
      std::abs(toSeconds(span()) / 2.0 - half_width_) > half_width_ / 4.0) {
    rebuild();
  }
}

template <int N>
void PolynomialFit<N>::replaceNewest(const Values& values) {
  assert(!samples_.empty());
  Sample& newest = samples_.back();
  fit_.correct(regressors(newest), values - newest.value);
  newest.value = values;
}

template <int N>
void PolynomialFit<N>::clear() {
  samples_.clear();
  fit_ = {};
}

template <int N>
Duration PolynomialFit<N>::span() const {
  return samples_.empty() ? Duration::zero() : samples_.back().stamp - samples_.front().stamp;
}

template <int N>
void PolynomialFit<N>::include(const Sample& sample) {
  fit_.add(regressors(sample), sample.value - origin_);
}

template <int N>
typename PolynomialFit<N>::Curve::Fit::Regressors PolynomialFit<N>::regressors(const Sample& sample) const {
  return legendre(toSeconds(sample.stamp - middle_) / half_width_);
}

template <int N>
void PolynomialFit<N>::dropOld(Duration least_span) {
  const Time oldest = samples_.back().stamp - window_;
  const Time spanned = samples_.back().stamp - least_span;
  const size_t kept = static_cast<size_t>(std::max(degree_ + 1, 2));
  while (samples_.size() > kept && samples_.front().stamp < oldest && samples_[1].stamp <= spanned) {
    const Sample& old = samples_.front();
    const double weight = std::pow(forgetting_factor_, static_cast<double>(samples_.size() - 1));
    fit_.add(regressors(old), old.value - origin_, -weight);
    samples_.pop_front();
  }
}

template <int N>
void PolynomialFit<N>::rebuild() {
  middle_ = samples_.front().stamp + span() / 2;
  half_width_ = std::max(toSeconds(span()) / 2.0, 1e-9);
  origin_ = samples_.back().value;
  fit_ = {};
  for (const Sample& sample : samples_) {
    fit_.forget(forgetting_factor_);
    include(sample);
  }
}

template <int N>
typename PolynomialFit<N>::Curve PolynomialFit<N>::curve(const Degrees& degrees) const {
  assert(!samples_.empty());
  Curve curve;
  curve.middle_ = middle_;
  curve.half_width_ = half_width_;
  curve.origin_ = origin_;
  const int possible = static_cast<int>(std::min<size_t>(samples_.size(), kTerms)) - 1;
  for (size_t axis = 0; axis < degrees.size(); ++axis) {
    assert(degrees[axis] <= degree_);
    curve.degrees_[axis] = std::min(degrees[axis], possible);
  }
  for (const int degree : curve.degrees_) {
    auto& coefficients = curve.by_degree_[static_cast<size_t>(degree)];
    if (coefficients.rows() == 0) coefficients = fit_.coefficients(degree + 1);
  }
  return curve;
}

template class PolynomialFit<PoseSpace::kSize>;
template class PolynomialFit<JointSpace::kSize>;

}  // namespace sweep_guard_core
