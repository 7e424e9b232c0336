#pragma once

#include "prediction/extrapolator.h"
#include "prediction/velocity.h"

namespace sweep_guard_core {

/// Extrapolates by the paper's predictor [P, Sec. 3.2]: an independent polynomial in time for each degree of freedom,
/// fitted by recursive least squares over an observation period. Degrees above 1 are used once half of that period is
/// observed.
class PolynomialExtrapolator : public Extrapolator {
 public:
  explicit PolynomialExtrapolator(const PredictorOptions& options);

  void observe(const PoseTracker& tracker) override;
  Vector6d displacementIn(double ahead) const override;

 private:
  std::array<int, 6> degree_;
  Duration window_;
  PolynomialFit fit_;
  PolynomialFit::Curve curve_;
  Time newest_;
  Vector6d coordinates_ = Vector6d::Zero();
};

}  // namespace sweep_guard_core
