#pragma once

#include <string>
#include <vector>

#include "monitor/input_record.h"
#include "monitor/repeated_positions.h"
#include "prediction/tool_jumps.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_ros {

/// Looks at the states of the tool as they come in for what no tool does, or no sender means. One thread, but for repeated().
class StateWatch {
 public:
  /// @param record  told of joints that are too fast, or beyond their limits
  StateWatch(const LiveParameters& live, sweep_guard_core::InputRecord& record);

  /// Adds the newest state.
  /// @returns what jumped to it, in words; empty: nothing
  std::string add(const sweep_guard_core::PoseWithFrames& state);

  /// Forgets where the tool was: what is placed anew does not jump.
  void reset() { jumps_.reset(); }

  const sweep_guard_core::RepeatedPositions& repeated() const { return repeated_; }  ///< any thread

 private:
  const LiveParameters& live_;
  sweep_guard_core::InputRecord& record_;
  const std::vector<sweep_guard_core::JointVariable> joints_;  // none of a rigid tool
  sweep_guard_core::ToolJumps jumps_;
  sweep_guard_core::RepeatedPositions repeated_;
};

}  // namespace sweep_guard_ros
