#include "sweep_guard/prediction/pose_predictor.h"

#include <cassert>

#include "prediction/motion_channel.h"

namespace sweep_guard_core {

PosePredictor::PosePredictor(const PredictorOptions& options)
    : channel_(std::make_unique<MotionChannel<PoseSpace>>(
          checked(options), PoseSpace{options.max_speed, options.max_turn_rate, options.constrained})) {}
PosePredictor::~PosePredictor() = default;
PosePredictor::PosePredictor(PosePredictor&&) noexcept = default;
PosePredictor& PosePredictor::operator=(PosePredictor&&) noexcept = default;

void PosePredictor::observe(const StampedPose& pose) { channel_->observe(pose); }

void PosePredictor::predict(const std::vector<Duration>& ahead, PredictedPath& path) const {
  path.clear();
  if (!channel_->knowsMotion()) return;
  for (const Duration& duration : ahead) {
    assert(duration > (path.empty() ? Duration::zero() : path.back().ahead));
    const double seconds = toSeconds(duration);
    PredictedPose pose;
    pose.ahead = duration;
    pose.X_WT = displaced(channel_->newest().X_WT, channel_->displacementIn(seconds));
    pose.covariance = channel_->covariance(seconds);
    path.push_back(pose);
  }
}

void PosePredictor::restart() { channel_->interrupt(); }

}  // namespace sweep_guard_core
