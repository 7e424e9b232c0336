#pragma once

#include <string>

#include "prediction/tool_jumps.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_ros {

/// Finds jumps of the tool and its joints in the states that come in, by the limits of now. One thread.
class JumpWatch {
 public:
  explicit JumpWatch(const LiveParameters& live);

  /// Adds the newest state: the last of the poses that the motion to it was cut into.
  /// @returns what jumped to it, in words; empty: nothing did
  std::string jumpTo(const sweep_guard_core::PoseWithFrames& state);

  /// Returns which joint moved to that state much faster than the robot description says, in words; empty: none.
  std::string faster() const { return jumps_.faster(); }

  void reset() { jumps_.reset(); }  ///< forgets all states

 private:
  const LiveParameters& live_;
  sweep_guard_core::ToolJumps jumps_;
};

}  // namespace sweep_guard_ros
