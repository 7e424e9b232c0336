#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/pose_leash.h"

namespace sweep_guard_core {

/// Follows commanded poses by velocities, so that these can be limited, and keeps the pose that was sent last. That begins
/// where the tool is, moves by the velocity that was let through, and leads the tool by no more than its PoseLeash allows.
/// It jumps only back to the tool, or towards it.
class PoseFollower {
 public:
  /// @param incremental  the tool shall move as the commands do, from where it is: what was held back is lost. Otherwise it
  ///     shall go to the commanded pose, and what was held back is caught up with
  /// @throws InvalidInput  if an option is NaN or out of range
  PoseFollower(const PoseLeash::Options& options, bool incremental)
      : options_(options), incremental_(incremental), leash_(options) {}

  bool begun() const { return sent_WT_.has_value(); }
  /// Begins where the tool is. If incremental, the next command moves nothing.
  void begin(const Eigen::Isometry3d& X_WT);
  /// Forgets everything: begin() comes next.
  void end();
  /// If incremental, takes the next command for where the tool is now, as a clutch does.
  void rebase() { command_WT_.reset(); }

  /// Takes note of where the tool is. A pose sent that leads it by too much is taken back to what is allowed; while one is
  /// held, only if the tool does not follow. Only after begin().
  void observe(const PoseLeash::Observation& tool);
  /// Takes the pose sent back to the tool. Only after observe().
  void takeBack();
  bool follows() const { return leash_.follows(); }  ///< false: the tool stays behind what was sent
  bool waits() const { return begun() && leash_.keepsWaiting(*sent_WT_); }  ///< for a tool that does not follow

  /// Returns the pose to be sent at a stop: at the first call after moveOn() at which the tool is known, where it comes to rest
  /// on its way to the pose sent last; then the same. Only after begin().
  /// @param tool_is_known  the newest observation shows where the tool is; false: until it does, the pose sent last is held
  const Eigen::Isometry3d& hold(bool tool_is_known);

  /// Returns the velocity that leads from the pose sent last to the command within `period`, or is as fast as is allowed.
  /// Only after begin().
  /// @param command_WT  rotation orthonormal
  /// @param period      > 0
  Twist towards(const Eigen::Isometry3d& command_WT, Duration period);

  /// Returns the next pose to be sent: moved on by what was let through of the velocity that towards() returned. It is bit
  /// for bit the command if that was let through as a whole and leads there.
  const Eigen::Isometry3d& moveOn(const Twist& let_through_W);

  /// Returns where the tool was observed last; empty: it was not.
  const std::optional<Eigen::Isometry3d>& tool() const { return tool_WT_; }
  /// Returns the pose sent last. Only after begin().
  const Eigen::Isometry3d& sent() const { return *sent_WT_; }
  /// Returns whether the pose sent last is the command itself.
  bool reached() const { return reached_; }

 private:
  Eigen::Isometry3d goalOf(const Eigen::Isometry3d& command_WT) const;

  const PoseLeash::Options options_;
  const bool incremental_;
  PoseLeash leash_;
  std::optional<Eigen::Isometry3d> sent_WT_;
  std::optional<Eigen::Isometry3d> tool_WT_;     // newest one
  std::optional<Eigen::Isometry3d> command_WT_;  // newest one
  Eigen::Isometry3d goal_WT_;                    // of the newest call of towards(), as the following
  Twist wanted_W_;
  bool leads_there_ = false;
  bool is_command_ = false;  // the goal is the command itself
  Duration period_{};
  bool held_ = false;
  bool reached_ = false;
};

}  // namespace sweep_guard_core
