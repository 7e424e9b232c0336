#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Reports a transform that is missing, or is not a rigid motion.
struct FrameError : sweep_guard_core::Error {
  using Error::Error;
};

/// Looks up poses of tf frames. Never interpolates beyond the buffer: a transform is taken at its stamp or not at all.
/// Any thread.
class Frames {
 public:
  Frames();

  /// Returns the pose of frame `source` in frame `target` at a stamp; stamp 0: the newest. Does not wait.
  /// @throws FrameError if there is none
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp) const;

  /// Returns the same pose, and waits up to `wait` on the steady clock for a transform that is late.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp,
                           sweep_guard_core::Duration wait) const;

  /// Returns the stamp of the newest transform between two frames; empty if there is none; 0 if it never changes.
  std::optional<sweep_guard_core::Time> newest(const std::string& target, const std::string& source) const;

  /// Calls back after every transform, in the thread of the listener, until the handle is destroyed.
  std::shared_ptr<void> onChange(std::function<void()> callback);

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace sweep_guard_ros
