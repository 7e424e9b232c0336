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

double positive(double limit, const char* name) {
  if (!(limit > 0.0)) throw InvalidInput(std::string(name) + " must be greater than 0");
  return limit;
}

Eigen::Vector3d limited(const Eigen::Vector3d& moved, double farthest) {
  const double distance = moved.norm();
  return distance > farthest ? Eigen::Vector3d(farthest / distance * moved) : moved;
}

}  // namespace

struct PosePredictor::Parts {
  explicit Parts(const PredictorOptions& options)
      : max_speed(positive(options.max_speed, "max_speed")),
        max_turn_rate(positive(options.max_turn_rate, "max_turn_rate")),
        track(max_speed, max_turn_rate),
        extrapolator(makeExtrapolator(options)) {}

  Vector6d displacementIn(double ahead) const {
    const Vector6d expected = extrapolator->displacementIn(ahead);
    Vector6d moved;
    moved << limited(expected.head<3>(), max_speed * ahead), limited(expected.tail<3>(), max_turn_rate * ahead);
    return moved;
  }

  double max_speed;
  double max_turn_rate;
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

PredictedPath PosePredictor::predict(const std::vector<Duration>& ahead) const {
  PredictedPath path;
  if (parts_->track.poses() < 2) return path;
  path.reserve(ahead.size());
  for (const Duration& duration : ahead) {
    assert(duration > (path.empty() ? Duration::zero() : path.back().ahead));
    const double seconds = toSeconds(duration);
    ExpectedPose pose;
    pose.ahead = duration;
    pose.X_WT = displaced(parts_->track.newest().X_WT, parts_->displacementIn(seconds));
    pose.covariance = parts_->errors.covariance(seconds);
    path.push_back(pose);
  }
  return path;
}

void PosePredictor::restart() { parts_->track.interrupt(); }

}  // namespace sweep_guard
