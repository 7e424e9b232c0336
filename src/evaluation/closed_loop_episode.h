#pragma once

#include <optional>
#include <vector>

#include "evaluation/closed_loop.h"
#include "evaluation/obstacle_placement.h"

namespace sweep_guard_evaluation {

struct ClosedLoopOptions {
  RobotLimits robot;
  RobotDelays delays;
  LoopGuardOptions guard;
  sweep_guard_core::Duration after = std::chrono::seconds(2);  ///< that an episode goes on after its end, >= 0
  size_t retreats = 8;                                         ///< in random directions from each place
};

/// A retreat from where the guard held the tool.
struct Retreat {
  enum class Kind { kAway, kBack, kMove, kTurn };
  Kind kind;
  double kept = 1.0;  ///< least share of the commanded speed
  double kept_near = 1.0;
  std::optional<double> time_until_free;  ///< until the gap has grown by 10 mm [s]
};

/// What happened at one placement.
struct ClosedLoopEpisode {
  std::optional<double> contact_speed;  ///< [m/s]
  double fastest_at_standoff = 0.0;     ///< [m/s]
  double least_gap = 0.0;
  double gap_at_begin = 0.0;
  size_t free_cycles = 0;     ///< without a surface within reach
  size_t free_changed = 0;    ///< of these: the output was not the command, bit for bit
  double least_kept = 1.0;    ///< share of the commanded speed
  double path_kept = 1.0;     ///< share of the commanded path
  std::vector<Retreat> retreats;
};

ClosedLoopEpisode runEpisode(const DrivenRobot& driven, const ObstaclePlacement& placement,
                             const ClosedLoopOptions& options, bool guarded, std::uint64_t seed);

}  // namespace sweep_guard_evaluation
