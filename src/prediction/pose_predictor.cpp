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

void PosePredictor::command(const SentCommand& command) {
  if (const auto* X_WT = std::get_if<Eigen::Isometry3d>(&command.value)) {
    channel_->command(StampedPose{command.stamp, *X_WT});
  } else if (const auto* commanded = std::get_if<CommandedTwist>(&command.value)) {
    const Eigen::Matrix3d R_WT = channel_->newest().X_WT.linear();
    Vector6d velocity =
        commanded->twist;  // as a tracker has it: translation along the axes of W, turn about those of T
    if (commanded->of_tool) {
      velocity.head<3>() = R_WT * velocity.head<3>();
    } else {
      velocity.tail<3>() = R_WT.transpose() * velocity.tail<3>();
    }
    channel_->command(command.stamp, velocity);
  }
}

bool PosePredictor::usesCommand() const { return channel_->usesCommand(); }

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
