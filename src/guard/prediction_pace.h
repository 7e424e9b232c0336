#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Decides when predictions may begin. Each pose has its own if that takes at most 45 % of the time; otherwise predictions
/// take 20 %, so that sweeps of poses and other processes find a processor. What they leave unused is kept for them, and
/// what they take too much is owed, for 10 ms.
class PredictionPace {
 public:
  /// Records a pose, unless it or a later one is recorded.
  void received(SteadyTime at);

  /// Records a prediction.
  /// @param took  time that it took, without sweeps of poses in between
  void predicted(SteadyTime begin, Duration took);

  /// Records a prediction at its end, also one that throws.
  struct Charge {
    PredictionPace& pace;
    SteadyTime begin;
    Duration interrupted{};  ///< time of sweeps of poses in between

    ~Charge() { pace.predicted(begin, std::chrono::steady_clock::now() - begin - interrupted); }
  };

  /// Returns when the next prediction may begin.
  SteadyTime due() const { return due_; }

  /// Returns when the prediction after the next may begin if the next takes as long as the newest.
  SteadyTime dueAfterNext() const { return due_ + interval_; }

 private:
  Duration pose_interval_{};  // smoothed
  Duration took_{};           // smoothed
  SteadyTime newest_pose_;
  Duration interval_{};  // between predictions as long as the newest
  SteadyTime due_;
};

}  // namespace sweep_guard_core
