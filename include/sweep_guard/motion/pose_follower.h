#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"

namespace sweep_guard_core {

/// How commanded poses are meant.
enum class PoseMode : std::uint8_t {
  kAbsolute,    ///< the tool shall go there; what was held back is caught up with later
  kIncremental  ///< the tool shall move as the commands do, from where it is; what was held back is lost
};

/// Follows commanded poses by velocities, so that these can be limited, and keeps the pose that was sent last. The pose
/// sent never jumps: it begins where the tool is, and moves by the velocity that was let through.
class PoseFollower {
 public:
  struct Options {
    PoseMode mode = PoseMode::kAbsolute;
    double max_speed = 0.25;     ///< [m/s], > 0
    double max_turn_rate = 1.0;  ///< [rad/s], > 0
  };

  /// @throws InvalidInput  if an option is NaN or out of range
  explicit PoseFollower(const Options& options);

  bool begun() const { return sent_WT_.has_value(); }
  /// Begins where the tool is. The next command of kIncremental moves nothing.
  void begin(const Eigen::Isometry3d& X_WT);
  /// Forgets everything: begin() comes next.
  void end();
  /// Takes the next command of kIncremental for where the tool is now, as a clutch does.
  void rebase() { command_WT_.reset(); }

  /// Returns the velocity that leads from the pose sent last to the command within `period`, or is as fast as is allowed.
  /// Only after begin().
  /// @param command_WT  rotation orthonormal
  /// @param period      > 0
  Twist towards(const Eigen::Isometry3d& command_WT, Duration period);

  /// Returns the next pose to be sent: moved on by what was let through of the velocity that towards() returned. It is bit
  /// for bit the command if that was let through as a whole and leads there.
  const Eigen::Isometry3d& moveOn(const Twist& let_through_W);

  /// Returns the pose sent last. Only after begin().
  const Eigen::Isometry3d& sent() const { return *sent_WT_; }
  /// Returns whether the pose sent last is the command itself.
  bool reached() const { return reached_; }

 private:
  const Options options_;
  std::optional<Eigen::Isometry3d> sent_WT_;
  std::optional<Eigen::Isometry3d> command_WT_;  // newest one
  Eigen::Isometry3d goal_WT_;                    // of the newest call of towards(), as the following
  Twist wanted_W_;
  bool leads_there_ = false;
  Duration period_{};
  bool reached_ = false;
};

}  // namespace sweep_guard_core
