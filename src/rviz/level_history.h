#pragma once

#include <deque>
#include <optional>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// How long the strip chart looks back.
constexpr auto kHistory = std::chrono::seconds(20);

/// Levels and times to collision of late.
class LevelHistory {
 public:
  struct Sample {
    SteadyTime since;  ///< in force from here to the next sample
    Light light;
    std::optional<double> time;  ///< to the collision [s], >= 0; empty: none, or not known
  };

  /// A sample earlier than the newest is taken for as late as that. What was over before kHistory ago is forgotten.
  void add(Sample sample);
  void clear() { samples_.clear(); }

  const std::deque<Sample>& samples() const { return samples_; }  ///< ascending in time

  /// Largest time to collision kept [s]; 0 without one.
  double longestTime() const;

 private:
  std::deque<Sample> samples_;
};

}  // namespace sweep_guard_rviz
