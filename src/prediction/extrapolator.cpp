#include "prediction/extrapolator.h"

#include <utility>

#include "prediction/direct_extrapolator.h"
#include "prediction/polynomial_extrapolator.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

template <typename Space>
class Hold : public Extrapolator<Space> {
 public:
  void observe(const MotionTracker<Space>& /*tracker*/) override {}
  typename Space::Vector displacementIn(double /*ahead*/) const override { return Space::Vector::Zero(); }
};

template <typename Space>
class ConstantVelocity : public Extrapolator<Space> {
 public:
  void observe(const MotionTracker<Space>& tracker) override { velocity_.observe(tracker); }
  typename Space::Vector displacementIn(double ahead) const override { return ahead * velocity_.value(); }

 private:
  Velocity<Space> velocity_{std::chrono::milliseconds(50)};
};

}  // namespace

template <typename Space>
std::unique_ptr<Extrapolator<Space>> makeExtrapolator(const PredictorOptions& options, const Space& space,
                                                      std::shared_ptr<LearnedMotion<Space>> learned) {
  if (options.predictor == "polynomial") return std::make_unique<PolynomialExtrapolator<Space>>(options);
  if (options.predictor == "constant_velocity") return std::make_unique<ConstantVelocity<Space>>();
  if (options.predictor == "hold") return std::make_unique<Hold<Space>>();
  if (options.predictor == "direct") {
    if (!learned) learned = std::make_shared<LearnedMotion<Space>>(space.priorSpeeds(), /*channels=*/1);
    return std::make_unique<DirectExtrapolator<Space>>(std::move(learned));
  }
  throw InvalidInput("predictor '" + options.predictor +
                     "' is unknown: use polynomial, constant_velocity, hold or direct");
}

template std::unique_ptr<Extrapolator<PoseSpace>> makeExtrapolator(const PredictorOptions& options,
                                                                   const PoseSpace& space,
                                                                   std::shared_ptr<LearnedMotion<PoseSpace>> learned);
template std::unique_ptr<Extrapolator<JointSpace>> makeExtrapolator(const PredictorOptions& options,
                                                                    const JointSpace& space,
                                                                    std::shared_ptr<LearnedMotion<JointSpace>> learned);

const std::vector<std::string>& predictorNames() {
  static const std::vector<std::string> names = {"polynomial", "constant_velocity", "hold", "direct"};
  return names;
}

}  // namespace sweep_guard_core
