#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sweep_guard/common/sample_buffer.h"
#include "sweep_guard/kinematics/kinematic_tree.h"
#include "sweep_guard/prediction/jump.h"

namespace sweep_guard_core {

/// Where the tool and its joints are at one moment, as its sources say: before the motion between two such states is cut.
struct ToolState {
  Time stamp;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< finite, rotation orthonormal; not checked
  std::vector<double> positions = {};                      ///< of each joint [rad or m], finite; not checked
};

/// Finds jumps of the tool in the fixed frame, and of its joints. One thread.
class ToolJumps {
 public:
  ToolJumps(std::string tool_frame, std::string fixed_frame, std::vector<JointVariable> joints)
      : tool_frame_(std::move(tool_frame)), fixed_frame_(std::move(fixed_frame)), joints_(std::move(joints)) {}

  /// Adds the newest state; stamps do not decrease.
  /// @returns what jumped to it, in words: a joint goes before the tool; empty: nothing did. Of a tool that goes on as fast, its
  ///     speed along the way
  std::string add(const ToolState& state, const SpeedLimits& limits);

  /// Returns which joint moved to the newest state at more than twice its velocity of the robot description; empty: none.
  std::string faster() const;

  void reset();  ///< forgets all states

 private:
  // Steps in a row that each were a jump of the tool.
  struct Run {
    ToolState from;
    double length = 0.0;  // [m]
    int steps = 0;
  };

  void noteRun(bool jumped);
  bool goesOn() const;
  template <typename MovedTo>
  std::optional<JumpSpeed> jumpOf(const MovedTo& moved, const SpeedLimits& limits) const;
  std::optional<JumpSpeed> jumpOfJoint(size_t joint, const SpeedLimits& limits) const;
  std::optional<JumpSpeed> jumpOfTool(const SpeedLimits& limits) const;
  void forgetOld();

  const std::string tool_frame_;
  const std::string fixed_frame_;
  const std::vector<JointVariable> joints_;
  std::optional<Run> run_;          // up to the newest state
  SampleBuffer<ToolState> states_;  // the first is the newest one that is older by 20 ms, if there is one
};

}  // namespace sweep_guard_core
