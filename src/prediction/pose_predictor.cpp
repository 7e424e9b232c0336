#include "sweep_guard/prediction/pose_predictor.h"

#include <cassert>

#include "prediction/motion_channel.h"

namespace sweep_guard_core {

struct PosePredictor::Impl {
  explicit Impl(const PredictorOptions& options)
      : channel(checked(options), PoseSpace{options.max_speed, options.max_turn_rate, options.constrained}) {}

  MotionChannel<PoseSpace> channel;
};

PosePredictor::PosePredictor(const PredictorOptions& options) : impl_(std::make_unique<Impl>(options)) {}
PosePredictor::~PosePredictor() = default;
PosePredictor::PosePredictor(PosePredictor&&) noexcept = default;
PosePredictor& PosePredictor::operator=(PosePredictor&&) noexcept = default;

void PosePredictor::observe(const StampedPose& pose) { impl_->channel.observe(pose); }

void PosePredictor::predict(const std::vector<Duration>& ahead, PredictedPath& path) const {
  const MotionChannel<PoseSpace>& channel = impl_->channel;
  path.clear();
  if (!channel.knowsMotion()) return;
  for (const Duration& duration : ahead) {
    assert(duration > (path.empty() ? Duration::zero() : path.back().ahead));
    const double seconds = toSeconds(duration);
    PredictedPose pose;
    pose.ahead = duration;
    pose.X_WT = displaced(channel.newest().X_WT, channel.displacementIn(seconds));
    pose.covariance = channel.covariance(seconds);
    path.push_back(pose);
  }
}

void PosePredictor::restart() { impl_->channel.interrupt(); }

}  // namespace sweep_guard_core
