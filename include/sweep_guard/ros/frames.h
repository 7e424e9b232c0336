#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <set>
#include <string>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// A transform is missing, or is not a rigid motion.
struct FrameError : sweep_guard::Error {
  using Error::Error;
};

/// Poses of tf frames. Never guesses: a transform is taken at its stamp or not at all. Any thread.
class Frames {
 public:
  Frames();

  /// Pose of frame `source` in frame `target` at a stamp; stamp 0: the newest there is. Does not wait.
  /// @throws FrameError if there is none
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp) const;

  /// The same, waiting for a transform that is on its way, on the steady clock.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp,
                           sweep_guard::Duration wait) const;

  tf2_ros::Buffer& buffer() { return buffer_; }

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace sweep_guard_ros
