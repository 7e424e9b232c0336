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

/// A transform is missing, or is not a rigid motion.
struct FrameError : sweep_guard_core::Error {
  using Error::Error;
};

/// Poses of tf frames. Never guesses: a transform is taken at its stamp or not at all. Any thread.
class Frames {
 public:
  Frames();

  /// Pose of frame `source` in frame `target` at a stamp; stamp 0: the newest there is. Does not wait.
  /// @throws FrameError if there is none
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp) const;

  /// The same, waiting for a transform that is on its way, on the steady clock.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp,
                           sweep_guard_core::Duration wait) const;

  /// Stamp of the newest transform between two frames; empty if there is none. 0 where it never changes.
  std::optional<sweep_guard_core::Time> newest(const std::string& target, const std::string& source) const;

  /// Calls back after every transform that comes in, in the thread of the listener, until the handle is destroyed.
  std::shared_ptr<void> onChange(std::function<void()> callback);

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace sweep_guard_ros
