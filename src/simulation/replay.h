#pragma once

#include <optional>
#include <vector>

#include "simulation/playback.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_simulation {

/// Plays a recorded motion pose by pose at the recorded intervals, moved to the workpiece. Keeps poses with equal
/// stamps.
class Replay {
 public:
  struct Options {
    bool loop = true;  ///< at the end plays backwards, then forwards again, without a jump; false: plays once
    Eigen::Vector3d target_W = Eigen::Vector3d::Zero();           ///< [m] lowest tip position within the window
    sweep_guard_core::Duration window = std::chrono::seconds(5);  ///< >= 0; from the first pose
  };

  /// @param motion  stamps not decreasing
  /// @throws sweep_guard_core::InvalidInput if the motion has no poses, or has no duration and shall loop
  Replay(std::vector<sweep_guard_core::StampedPose> motion, const Options& options);

  /// Returns the next pose, with its stamp counted from the first pose (0); empty after the last pose.
  std::optional<sweep_guard_core::StampedPose> next() { return playback_.next(); }

 private:
  Playback<sweep_guard_core::StampedPose> playback_;
};

}  // namespace sweep_guard_simulation
