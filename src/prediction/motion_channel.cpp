#include "prediction/motion_channel.h"

#include <utility>

#include "common/number_text.h"
#include "prediction/polynomial_fit.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr auto kActivityWindow = std::chrono::milliseconds(120);

void check(bool good, const std::string& complaint) {
  if (!good) throw InvalidInput(complaint);
}

}  // namespace

template <typename Space>
MotionChannel<Space>::MotionChannel(const PredictorOptions& options, const Space& space,
                                    std::shared_ptr<LearnedMotion<Space>> learned)
    : tracker_(space),
      velocity_(kActivityWindow),
      learned_(learned ? std::move(learned)
                       : std::make_shared<LearnedMotion<Space>>(space.priorSpeeds(), /*channels=*/1)),
      extrapolator_(makeExtrapolator(options, learned_)),
      errors_(space) {}

template <typename Space>
void MotionChannel<Space>::observe(const typename Space::Sample& sample) {
  tracker_.add(sample);
  velocity_.observe(tracker_);
  extrapolator_->observe(tracker_);
  PredictedDisplacements<Space> predicted;
  for (size_t i = 0; i < predicted.size(); ++i) predicted[i] = displacementMeasured(kLearnedHorizons[i]);
  errors_.observe(tracker_, velocity_.value(), predicted);
  if (commanded_) commanded_->observe(tracker_, *extrapolator_->regressors(), velocity_.value(), errors_);
}

template <typename Space>
void MotionChannel<Space>::interrupt() {
  tracker_.interrupt();
  if (commanded_) commanded_->interrupt();
}

template class MotionChannel<PoseSpace>;
template class MotionChannel<JointSpace>;

const PredictorOptions& checked(const PredictorOptions& options) {
  for (const int degree : options.degree) {
    check(degree >= 0 && degree <= kMaxPolynomialDegree, "prediction degree " + std::to_string(degree) +
                                                             " is out of range: use 0 to " +
                                                             std::to_string(kMaxPolynomialDegree));
  }
  check(options.forgetting_factor > 0.0 && options.forgetting_factor <= 1.0,
        "forgetting factor " + shortText(options.forgetting_factor) + " is out of range: use more than 0, at most 1");
  check(options.window > Duration::zero(), "the observation window must be longer than 0 s");
  check(options.max_speed > 0.0, "max_speed must be greater than 0");
  check(options.max_turn_rate > 0.0, "max_turn_rate must be greater than 0");
  return options;
}

}  // namespace sweep_guard_core
