#pragma once

#include <array>
#include <boost/circular_buffer.hpp>

#include "prediction/rls.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

constexpr int kMaxPolynomialDegree = 5;

/// Fits N values by polynomials in time over a sliding window: recursive least squares with exponential forgetting on
/// an observation period [P, Sec. 3.2].
///
/// The fit uses Legendre polynomials about the middle of the window. When the window has moved by an eighth, the fit is
/// rebuilt from its samples. It therefore stays well conditioned however long it runs, at constant cost per sample.
template <int N>
class PolynomialFit {
 public:
  using Degrees = std::array<int, N>;  ///< one for each value, 0 to kMaxPolynomialDegree
  using Values = Eigen::Matrix<double, N, 1>;

  /// The fitted polynomials. A snapshot: later samples do not change it.
  class Curve {
   public:
    Values at(Time stamp) const;       ///< the values
    Values slopeAt(Time stamp) const;  ///< their derivative [1/s]

   private:
    friend class PolynomialFit;
    using Fit = Rls<kMaxPolynomialDegree + 1, N>;
    double abscissa(Time stamp) const { return toSeconds(stamp - middle_) / half_width_; }
    Values sum(const Values& constant, const typename Fit::Regressors& terms) const;

    Time middle_;
    double half_width_ = 1.0;
    Values origin_;
    Degrees degrees_;
    std::array<typename Fit::Coefficients, kMaxPolynomialDegree + 1> by_degree_;  // for the degrees in use
  };

  /// @param degree             largest that curve() may use, 0 to kMaxPolynomialDegree
  /// @param window             older samples are dropped, except the newest degree + 1; > 0
  /// @param forgetting_factor  weight of a sample relative to the next one, in (0, 1]
  PolynomialFit(int degree, Duration window, double forgetting_factor);

  /// Adds a sample.
  /// @param stamp       later than the previous sample's
  /// @param least_span  older samples than the window's are kept where the window spans less
  void add(Time stamp, const Values& values, Duration least_span = {});
  /// Replaces the values of the newest sample.
  void replaceNewest(const Values& values);
  void clear();

  size_t size() const { return samples_.size(); }  ///< number of samples in the window
  Duration span() const;                           ///< from the oldest sample to the newest

  /// Returns the fitted polynomials. There must be a sample.
  /// @param degrees  each at most that of the constructor; lowered if there are too few samples
  Curve curve(const Degrees& degrees) const;

 private:
  using Sample = StampedValue<Values>;

  void include(const Sample& sample);
  typename Curve::Fit::Regressors regressors(const Sample& sample) const;
  void dropOld(Duration least_span);
  void rebuild();

  int degree_;
  Duration window_;
  double forgetting_factor_;
  boost::circular_buffer<Sample> samples_;
  typename Curve::Fit fit_;
  Time middle_;
  double half_width_ = 1.0;  // [s]
  Values origin_ = Values::Zero();
};

}  // namespace sweep_guard_core
