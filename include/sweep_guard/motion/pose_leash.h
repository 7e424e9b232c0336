#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Returns how far apart two poses are: the seconds that a motion at the largest speed and turn rate takes.
double secondsBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double max_speed, double max_turn_rate);

/// Bounds how far the pose that is sent to a robot may lead its tool. A robot that was stopped makes up for the whole lead
/// as fast as it can when it is released.
///
/// A tool that follows at the largest speed lags by the dead time, the time constant, the period of the poses that are sent
/// and the age of its own pose: that is the whole reach. A tool does not follow if it moves by less than a tenth of what it
/// was behind, in the dead time and two time constants, and the period and age until its pose shows that. The reach is then
/// the time constant alone, and grows by what the tool moves from there. Reaches are in seconds at the largest speed and
/// turn rate.
class PoseLeash {
 public:
  /// Limits of the tool, and how the robot follows.
  struct Options {
    double max_speed = 0.25;     ///< [m/s], > 0
    double max_turn_rate = 1.0;  ///< [rad/s], > 0
    Duration dead_time{};        ///< until the robot begins to do what was sent, >= 0
    Duration time_constant{};    ///< of the first-order lag with which the robot follows, >= 0
    double deceleration = 1.0;   ///< that the robot reaches when it is stopped [m/s^2], > 0
  };
  /// A shorter time constant counts as this: without any reach, nothing could move.
  static constexpr Duration kLeastLag = std::chrono::milliseconds(10);

  /// What is known of the tool when a pose is to be sent.
  struct Observation {
    Eigen::Isometry3d X_WT;                                     ///< newest pose
    Duration age;                                               ///< of the tool pose, >= 0
    Duration period;                                            ///< longest time between two poses that are sent, > 0
    SteadyTime now;                                             ///< not before that of the last observation
    Eigen::Isometry3d sent_WT = Eigen::Isometry3d::Identity();  ///< pose sent last; observe() fills it in
  };

  /// @throws InvalidInput  if an option is NaN or out of range
  explicit PoseLeash(const Options& options);

  void clear();  ///< forgets all observations
  /// @param sent_WT  pose sent last
  void observe(const Observation& seen, const Eigen::Isometry3d& sent_WT);

  bool follows() const { return !stood_WT_; }  ///< the tool goes where it is sent
  /// Returns whether a pose waits for a tool that does not follow: it lies before the newest pose of the tool.
  bool keepsWaiting(const Eigen::Isometry3d& sent_WT) const;
  double reach() const;  ///< [s]; only after observe()

  /// Returns the pose itself if it is within reach of the newest pose of the tool, else the nearest one that is: the
  /// translation and the turn each are cut. Only after observe().
  Eigen::Isometry3d within(const Eigen::Isometry3d& pose_WT) const;

  /// Returns where the tool comes to rest on its way to the pose sent last if it decelerates now: at the newest pose if it
  /// does not come nearer to that, and not beyond it. A turn takes as long as a translation at the same share of its
  /// largest speed does. Only after observe().
  Eigen::Isometry3d rest(const Eigen::Isometry3d& sent_WT) const;

 private:
  static constexpr size_t kSamples = 128;

  double between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    return secondsBetween(a, b, options_.max_speed, options_.max_turn_rate);
  }
  const Observation& before(size_t newest) const { return ring_[(next_ + kSamples - 1 - newest) % kSamples]; }
  void remember(const Eigen::Isometry3d& sent_WT);
  bool hasStood(const Eigen::Isometry3d& sent_WT) const;
  double approach(const Eigen::Isometry3d& sent_WT) const;

  const Options options_;
  const Duration lag_;  // time constant, at least kLeastLag
  std::array<Observation, kSamples> ring_;
  size_t next_ = 0;
  size_t count_ = 0;
  Observation seen_{};
  Eigen::Isometry3d sent_WT_;                  // of the newest observation, within reach
  bool moved_on_ = false;                      // the pose sent, since the tool was found not to follow
  std::optional<Eigen::Isometry3d> stood_WT_;  // where the tool does not follow; empty: it follows
};

}  // namespace sweep_guard_core
