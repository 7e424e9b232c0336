#pragma once

#include <array>
#include <boost/circular_buffer.hpp>

#include "prediction/rls.h"
#include "sweep_guard/common/matrix6.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Fits six values by polynomials in time over a sliding window: recursive least squares with exponential forgetting on
/// an observation period [P, Sec. 3.2].
///
/// The fit is held in Legendre polynomials about the middle of the window, and made anew from the window's samples when
/// the window has moved on by an eighth: so it stays as well conditioned as at first, however long it runs, at constant
/// cost per sample.
class PolynomialFit {
 public:
  static constexpr int kMaxDegree = 5;
  using Degrees = std::array<int, 6>;  ///< one for each value, 0 to kMaxDegree

  struct Options {
    int degree = 1;                  ///< highest that will be asked for, 0 to kMaxDegree
    Duration window{};               ///< no older sample counts, but for the newest degree + 1; > 0
    double forgetting_factor = 1.0;  ///< weight of a sample over that of the next one, in (0, 1]
  };

  /// What was fitted. A snapshot: later samples do not change it.
  class Curve {
   public:
    Vector6d at(Time stamp) const;       ///< the values
    Vector6d slopeAt(Time stamp) const;  ///< their derivative [1/s]

   private:
    friend class PolynomialFit;
    using Fit = Rls<kMaxDegree + 1, 6>;
    double abscissa(Time stamp) const { return toSeconds(stamp - middle_) / half_width_; }
    Vector6d sum(const Vector6d& constant, const Fit::Regressors& terms) const;

    Time middle_;
    double half_width_ = 1.0;
    Vector6d origin_;
    Degrees degrees_;
    std::array<Fit::Coefficients, kMaxDegree + 1> by_degree_;  // of the degrees that are used
  };

  explicit PolynomialFit(const Options& options);

  /// @param stamp  later than that of the sample before
  void add(Time stamp, const Vector6d& values);
  /// Corrects the newest sample.
  void replaceNewest(const Vector6d& values);
  void clear();

  size_t size() const { return samples_.size(); }  ///< samples in the window
  Duration span() const;                           ///< from the oldest to the newest of them

  /// @param degrees  each at most Options::degree; lowered where there are too few samples. There must be a sample
  Curve curve(const Degrees& degrees) const;

 private:
  struct Sample {
    Time stamp;
    Vector6d values;
  };
  void include(const Sample& sample);
  void dropOld();
  void rebuild();

  Options options_;
  boost::circular_buffer<Sample> samples_;
  Curve::Fit fit_;
  Time middle_;
  double half_width_ = 1.0;  // [s]
  Vector6d origin_ = Vector6d::Zero();
};

}  // namespace sweep_guard_core
