#include "ros/haptics/device_axes.h"

#include "ros/motion/command_frames.h"

namespace sweep_guard_ros {

using sweep_guard_core::Time;

DeviceAxes::DeviceAxes(Frames& frames, const std::string& fixed_frame, const std::string& device_frame)
    : frames_(frames),
      fixed_frame_(fixed_frame),
      device_frame_(device_frame),
      transforms_changed_(frames.onChange([this] { lookUp(); })) {
  lookUp();
}

std::optional<Eigen::Matrix3d> DeviceAxes::newest(Time now) const {
  const sweep_guard_core::Lock lock(mutex_);
  if (!newest_) return {};
  const bool old = newest_->stamp != Time() && std::chrono::abs(now - newest_->stamp) > kOldestTransform;
  return old ? std::nullopt : std::optional(newest_->value);
}

std::string DeviceAxes::problem() const {
  try {
    newestPose(frames_, fixed_frame_, device_frame_);
    return {};
  } catch (const FrameError& error) {
    return error.what();
  }
}

void DeviceAxes::lookUp() {
  std::optional<sweep_guard_core::StampedValue<Eigen::Matrix3d>> found;
  try {
    const std::optional<Time> stamp = frames_.newest(fixed_frame_, device_frame_);
    if (stamp) found = {*stamp, frames_.lookup(fixed_frame_, device_frame_, *stamp).linear()};
  } catch (const FrameError&) {  // problem() tells it
  }
  const sweep_guard_core::Lock lock(mutex_);
  newest_ = found;
}

}  // namespace sweep_guard_ros
