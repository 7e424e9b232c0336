#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/motion/braking.h"

namespace sweep_guard_core {

/// Remembers the velocities that were sent to the robot lately: twists of the tool, or speeds of joints. The newest pose, or the
/// newest positions, do not show yet what they do: a limiter that does not count them lets the tool overshoot the standoff, as a
/// control loop with a delay does. So limit the balls of the tool both where they are and where they are expected.
class MotionInFlight {
 public:
  /// How many velocities are remembered: 8 s at 1 kHz, and no less at higher rates.
  static constexpr size_t kCapacity = 8192;

  /// @param dimension  number of components of a velocity; 6: of a twist
  explicit MotionInFlight(size_t dimension = 6);

  /// Adds a velocity that takes effect until the next one. Of velocities that follow each other within 2 ms, the mean is
  /// remembered. Allocates nothing.
  /// @param sent  not before that of the last call
  void add(const Eigen::Ref<const Eigen::VectorXd>& velocity, SteadyTime sent);
  void add(const Twist& twist_W, SteadyTime sent);

  /// Adds up what was sent in the last `window`. Before the oldest velocity, the robot is taken to be at rest.
  /// @param now     not before the last velocity was sent
  /// @param window  age of the measured state + the robot's dead time + twice the time constant of its lag, >= 0
  /// @param[out] displacement  of the dimension; overwritten
  void addUp(SteadyTime now, Duration window, Eigen::Ref<Eigen::VectorXd> displacement) const;

  /// Returns the pose at which the tool comes to rest if the robot still carries out what was sent in the last `window`,
  /// then nothing. Of twists only.
  /// @param X_WT  newest pose
  Eigen::Isometry3d expectedPose(const Eigen::Isometry3d& X_WT, SteadyTime now, Duration window) const;

  void clear() { count_ = 0; }  ///< the robot has rested for longer than the window

 private:
  static size_t placeBefore(size_t next, size_t newest) { return (next + kCapacity - 1 - newest) % kCapacity; }
  auto velocityAt(size_t place) { return velocities_.col(static_cast<Eigen::Index>(place)); }
  void joinNewest(SteadyTime until);

  std::vector<SteadyTime> sent_;
  Eigen::MatrixXd velocities_;  // a column each
  size_t next_ = 0;
  size_t count_ = 0;
};

}  // namespace sweep_guard_core
