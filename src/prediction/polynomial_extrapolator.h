#pragma once

#include "prediction/extrapolator.h"
#include "prediction/velocity.h"

namespace sweep_guard_core {

/// Extrapolates by the paper's predictor [P, Sec. 3.2]: an independent polynomial in time for each degree of freedom,
/// fitted by recursive least squares over an observation period. Degrees above 1 are used once half of that period is
/// observed.
template <typename Space>
class PolynomialExtrapolator : public Extrapolator<Space> {
 public:
  using Vector = typename Space::Vector;

  explicit PolynomialExtrapolator(const PredictorOptions& options);

  void observe(const MotionTracker<Space>& tracker) override;
  Vector displacementIn(double ahead) const override;

 private:
  using Fit = PolynomialFit<Space::kSize>;

  typename Fit::Degrees degrees_;
  Duration window_;
  Fit fit_;
  typename Fit::Curve curve_;
  Time newest_;
  Vector coordinates_ = Vector::Zero();
};

}  // namespace sweep_guard_core
