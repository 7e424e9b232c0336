#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/motion/braking.h"

namespace sweep_guard_core {

/// Remembers the velocities that were sent to the robot lately. The newest pose does not show yet what they do: a limiter
/// that does not count them lets the tool overshoot the standoff, as a control loop with a delay does. So limit the balls
/// of the tool both where it is and where it is expected.
class MotionInFlight {
 public:
  /// How many velocities are remembered: 8 s at 1 kHz, and no less at higher rates.
  static constexpr size_t kCapacity = 8192;

  /// Adds a velocity that takes effect until the next one. Of velocities that follow each other within 2 ms, the mean is
  /// remembered.
  /// @param sent  not before that of the last call
  void add(const Twist& twist_W, SteadyTime sent);

  /// Returns the pose at which the tool comes to rest if the robot still carries out what was sent in the last `window`,
  /// then nothing. Before the oldest velocity, the robot is taken to be at rest.
  /// @param X_WT    newest pose
  /// @param now     not before the last velocity was sent
  /// @param window  age of the pose + the robot's dead time + twice the time constant of its lag, >= 0
  Eigen::Isometry3d expectedPose(const Eigen::Isometry3d& X_WT, SteadyTime now, Duration window) const;

  void clear() { count_ = 0; }  ///< the robot has rested for longer than the window

 private:
  using Sent = StampedValue<Twist, SteadyTime>;  // twist_W
  static size_t placeBefore(size_t next, size_t newest) { return (next + kCapacity - 1 - newest) % kCapacity; }
  const Sent& before(size_t newest) const { return ring_[placeBefore(next_, newest)]; }
  void joinNewest(SteadyTime until);

  std::array<Sent, kCapacity> ring_;
  size_t next_ = 0;
  size_t count_ = 0;
};

}  // namespace sweep_guard_core
