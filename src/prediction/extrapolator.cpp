#include "prediction/extrapolator.h"

#include "prediction/direct_extrapolator.h"
#include "prediction/polynomial_extrapolator.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

class Hold : public Extrapolator {
 public:
  void observe(const PoseTracker& /*tracker*/) override {}
  Vector6d displacementIn(double /*ahead*/) const override { return Vector6d::Zero(); }
};

class ConstantVelocity : public Extrapolator {
 public:
  void observe(const PoseTracker& tracker) override { velocity_.observe(tracker); }
  Vector6d displacementIn(double ahead) const override { return ahead * velocity_.value(); }

 private:
  Velocity velocity_{std::chrono::milliseconds(50)};
};

}  // namespace

std::unique_ptr<Extrapolator> makeExtrapolator(const PredictorOptions& options) {
  if (options.predictor == "polynomial") return std::make_unique<PolynomialExtrapolator>(options);
  if (options.predictor == "constant_velocity") return std::make_unique<ConstantVelocity>();
  if (options.predictor == "hold") return std::make_unique<Hold>();
  if (options.predictor == "direct") return std::make_unique<DirectExtrapolator>(options.profile.get());
  throw InvalidInput("predictor '" + options.predictor +
                     "' is unknown: use polynomial, constant_velocity, hold or direct");
}

const std::vector<std::string>& predictorNames() {
  static const std::vector<std::string> names = {"polynomial", "constant_velocity", "hold", "direct"};
  return names;
}

}  // namespace sweep_guard_core
