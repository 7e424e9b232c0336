#include "sweep_guard/prediction/pose_predictor.h"

#include <algorithm>
#include <cassert>

#include "sweep_guard/common/error.h"
#include "sweep_guard/prediction/error_model.h"
#include "sweep_guard/prediction/extrapolator.h"
#include "sweep_guard/prediction/velocity.h"

namespace sweep_guard {
namespace {

constexpr auto kActivityWindow = std::chrono::milliseconds(120);

void check(bool good, const std::string& complaint) {
  if (!good) throw InvalidInput(complaint);
}

const PredictorOptions& checked(const PredictorOptions& options) {
  for (const int degree : options.degree) {
    check(degree >= 0 && degree <= PolynomialFit::kHighestDegree, "prediction degree " + std::to_string(degree) +
                                                                      " is out of range: use 0 to " +
                                                                      std::to_string(PolynomialFit::kHighestDegree));
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

struct PosePredictor::Parts {
  explicit Parts(const PredictorOptions& options)
      : constrained(checked(options).constrained),
        track(options.max_speed, options.max_turn_rate),
        extrapolator(makeExtrapolator(options)) {}

  Vector6d displacementIn(double ahead) const {
    Vector6d expected = extrapolator->displacementIn(ahead);
    for (int axis = 0; axis < 6; ++axis) {
      if (constrained[static_cast<size_t>(axis)]) expected[axis] = 0.0;
    }
    Vector6d moved;
    moved << limited(expected.head<3>(), track.maxSpeed() * ahead),
        limited(expected.tail<3>(), track.maxTurnRate() * ahead);
    return moved;
  }

  std::array<bool, 6> constrained;
  MotionTrack track;
  Velocity velocity{kActivityWindow};
  std::unique_ptr<Extrapolator> extrapolator;
  ErrorModel errors;
};

PosePredictor::PosePredictor(const PredictorOptions& options) : parts_(std::make_unique<Parts>(options)) {}
PosePredictor::~PosePredictor() = default;
PosePredictor::PosePredictor(PosePredictor&&) noexcept = default;
PosePredictor& PosePredictor::operator=(PosePredictor&&) noexcept = default;

void PosePredictor::observe(const StampedPose& pose) {
  parts_->track.add(pose);
  parts_->velocity.observe(parts_->track);
  parts_->extrapolator->observe(parts_->track);
  Forecast forecast;
  for (size_t i = 0; i < forecast.size(); ++i) forecast[i] = parts_->displacementIn(kLearnedAhead[i]);
  parts_->errors.observe(parts_->track, parts_->velocity.value(), forecast);
}

void PosePredictor::predict(const std::vector<Duration>& ahead, PredictedPath& path) const {
  path.clear();
  if (parts_->track.poses() < 2) return;
  for (const Duration& duration : ahead) {
    assert(duration > (path.empty() ? Duration::zero() : path.back().ahead));
    const double seconds = toSeconds(duration);
    ExpectedPose pose;
    pose.ahead = duration;
    pose.X_WT = displaced(parts_->track.newest().X_WT, parts_->displacementIn(seconds));
    pose.covariance = parts_->errors.covariance(seconds);
    path.push_back(pose);
  }
}

PredictedPath PosePredictor::predict(const std::vector<Duration>& ahead) const {
  PredictedPath path;
  predict(ahead, path);
  return path;
}

void PosePredictor::restart() { parts_->track.interrupt(); }

}  // namespace sweep_guard
