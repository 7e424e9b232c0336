#include "prediction/extrapolator.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "prediction/direct_extrapolator.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Extrapolates by the paper's predictor [P, Sec. 3.2]: an independent polynomial in time for each degree of freedom,
// fitted by recursive least squares over an observation period. Degrees above 1 are used once half of that period is
// observed.
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
  double trust_ = 0.0;
};

template <typename Space>
PolynomialExtrapolator<Space>::PolynomialExtrapolator(const PredictorOptions& options)
    : degrees_(Space::degreesOf(options)),
      window_(options.window),
      fit_(*std::max_element(degrees_.begin(), degrees_.end()), options.window, options.forgetting_factor) {}

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
  trust_ = tracker.trustIn(fit_.span());
}

template <typename Space>
typename Space::Vector PolynomialExtrapolator<Space>::displacementIn(double ahead) const {
  return trust_ * (curve_.at(newest_ + fromSeconds(ahead)) - coordinates_);
}

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
std::unique_ptr<Extrapolator<Space>> makeExtrapolator(const PredictorOptions& options,
                                                      const std::shared_ptr<LearnedMotion<Space>>& learned) {
  if (options.predictor == "polynomial") return std::make_unique<PolynomialExtrapolator<Space>>(options);
  if (options.predictor == "constant_velocity") return std::make_unique<ConstantVelocity<Space>>();
  if (options.predictor == "hold") return std::make_unique<Hold<Space>>();
  if (options.predictor == "direct") return std::make_unique<DirectExtrapolator<Space>>(learned);
  throw InvalidInput("predictor '" + options.predictor +
                     "' is unknown: use polynomial, constant_velocity, hold or direct");
}

template std::unique_ptr<Extrapolator<PoseSpace>> makeExtrapolator(
    const PredictorOptions& options, const std::shared_ptr<LearnedMotion<PoseSpace>>& learned);
template std::unique_ptr<Extrapolator<JointSpace>> makeExtrapolator(
    const PredictorOptions& options, const std::shared_ptr<LearnedMotion<JointSpace>>& learned);

const std::vector<std::string>& predictorNames() {
  static const std::vector<std::string> names = {"polynomial", "constant_velocity", "hold", "direct"};
  return names;
}

}  // namespace sweep_guard_core
