#include "sweep_guard/prediction/pose_predictor.h"

#include <algorithm>
#include <cassert>

#include "prediction/error_model.h"
#include "prediction/extrapolator.h"
#include "prediction/profile.h"
#include "prediction/velocity.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr auto kActivityWindow = std::chrono::milliseconds(120);

void check(bool good, const std::string& complaint) {
  if (!good) throw InvalidInput(complaint);
}

const PredictorOptions& checked(const PredictorOptions& options) {
  for (const int degree : options.degree) {
    check(degree >= 0 && degree <= PolynomialFit::kMaxDegree, "prediction degree " + std::to_string(degree) +
                                                                  " is out of range: use 0 to " +
                                                                  std::to_string(PolynomialFit::kMaxDegree));
  }
  check(options.forgetting_factor > 0.0 && options.forgetting_factor <= 1.0,
        "forgetting factor " + std::to_string(options.forgetting_factor) +
            " is out of range: use more than 0, at most 1");
  check(options.window > Duration::zero(), "the observation window must be longer than 0 s");
  check(options.max_speed > 0.0, "max_speed must be greater than 0");
  check(options.max_turn_rate > 0.0, "max_turn_rate must be greater than 0");
  return options;
}

}  // namespace

struct PosePredictor::Impl {
  explicit Impl(const PredictorOptions& options)
      : constrained(checked(options).constrained),
        tracker(options.max_speed, options.max_turn_rate),
        extrapolator(makeExtrapolator(options)) {
    if (options.profile && options.predictor == "direct") errors.begin(options.profile->errors);
  }

  Vector6d displacementIn(double ahead) const {
    Vector6d expected = extrapolator->displacementIn(ahead);
    for (int axis = 0; axis < 6; ++axis) {
      if (constrained[static_cast<size_t>(axis)]) expected[axis] = 0.0;
    }
    Vector6d moved;
    moved << limited(expected.head<3>(), tracker.maxSpeed() * ahead),
        limited(expected.tail<3>(), tracker.maxTurnRate() * ahead);
    return moved;
  }

  std::array<bool, 6> constrained;
  PoseTracker tracker;
  Velocity velocity{kActivityWindow};
  std::unique_ptr<Extrapolator> extrapolator;
  ErrorModel errors;
};

PosePredictor::PosePredictor(const PredictorOptions& options) : impl_(std::make_unique<Impl>(options)) {}
PosePredictor::~PosePredictor() = default;
PosePredictor::PosePredictor(PosePredictor&&) noexcept = default;
PosePredictor& PosePredictor::operator=(PosePredictor&&) noexcept = default;

void PosePredictor::observe(const StampedPose& pose) {
  impl_->tracker.add(pose);
  impl_->velocity.observe(impl_->tracker);
  impl_->extrapolator->observe(impl_->tracker);
  PredictedDisplacements predicted;
  for (size_t i = 0; i < predicted.size(); ++i) predicted[i] = impl_->displacementIn(kLearnedHorizons[i]);
  impl_->errors.observe(impl_->tracker, impl_->velocity.value(), predicted);
}

void PosePredictor::predict(const std::vector<Duration>& ahead, PredictedPath& path) const {
  path.clear();
  if (impl_->tracker.poses() < 2) return;
  for (const Duration& duration : ahead) {
    assert(duration > (path.empty() ? Duration::zero() : path.back().ahead));
    const double seconds = toSeconds(duration);
    PredictedPose pose;
    pose.ahead = duration;
    pose.X_WT = displaced(impl_->tracker.newest().X_WT, impl_->displacementIn(seconds));
    pose.covariance = impl_->errors.covariance(seconds);
    path.push_back(pose);
  }
}

std::unique_ptr<Profile> PosePredictor::profile() const {
  auto profile = std::make_unique<Profile>();
  if (!impl_->extrapolator->save(*profile)) return nullptr;
  profile->errors = impl_->errors.shares();
  return profile;
}

void PosePredictor::restart() { impl_->tracker.interrupt(); }

}  // namespace sweep_guard_core
