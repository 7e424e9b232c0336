#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_simulation {

/// A recorded motion moved to the workpiece and played pose by pose at the intervals it was recorded at. Every pose is
/// given, also those that share a stamp.
class Replay {
 public:
  struct Options {
    bool loop = true;  ///< at the end play backwards, then forwards again, without a jump; false: play once
    Eigen::Vector3d target_W = Eigen::Vector3d::Zero();  ///< [m] where the lowest tip position of the window shall lie
    sweep_guard_core::Duration window = std::chrono::seconds(5);  ///< >= 0; from the first pose
  };

  /// @param motion  stamps not decreasing
  /// @throws sweep_guard_core::InvalidInput if the motion has no poses, or is to loop and lasts no time
  Replay(std::vector<sweep_guard_core::StampedPose> motion, const Options& options);

  /// The next pose, its stamp counted from the first pose (0); empty after the last.
  std::optional<sweep_guard_core::StampedPose> next();

 private:
  std::vector<sweep_guard_core::StampedPose> motion_;
  bool loop_;
  std::size_t index_ = 0;
  sweep_guard_core::Time stamp_;
};

}  // namespace sweep_guard_simulation
