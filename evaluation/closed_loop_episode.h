#pragma once

#include <optional>
#include <vector>

#include "evaluation/closed_loop_options.h"
#include "evaluation/obstacle_placement.h"
#include "evaluation/retreat.h"

namespace sweep_guard_evaluation {

/// What happened at one placement.
struct ClosedLoopEpisode {
  std::optional<LoopCycle::Contact> contact;  ///< ends the episode
  double standoff_speed = 0.0;                ///< largest closing speed at the standoff or behind it [m/s]
  size_t free_commands = 0;                   ///< while no surface was within reach
  size_t free_changed = 0;                    ///< of these: not passed on bit for bit
  bool slowed = false;                        ///< a command was not passed on bit for bit
  double path_kept = 1.0;                     ///< share of the commanded path of the fastest tool point
  std::vector<Retreat> retreats;
};

struct EpisodeKind {
  /// The surface comes along its normal to the tool, and is where the placement has it when the placement ends. False:
  /// it rests there.
  bool surface_comes = false;
  bool guarded = true;     ///< false: commands go to the robot as they are
  std::uint64_t seed = 1;  ///< of the retreats, and of the speed of a surface that comes, 0.05 to 0.3 m/s
};

/// Returns a cylinder as a tool of pieces end to end.
sweep_guard_core::Tool inPieces(const sweep_guard_core::ConvexShape& cylinder, size_t count);

/// Returns when the episode of a placement may begin: at the latest cycle, not after that of the placement, at which the
/// tool is beyond the standoff and a guard has passed on every command for 0.2 s. A tool that is already too near and too
/// fast when a surface appears could not be stopped by any guard. Empty: there is no such cycle in the 4 s before.
std::optional<sweep_guard_core::Time> beginOf(const DrivenRobot& driven, const ObstaclePlacement& placement,
                                              const ClosedLoopOptions& options);

/// Runs one placement, until 2 s after its end, to the first contact or to a gap of the recording. The retreats are those
/// from where a guard took most of a command, if that was more than half of it, before a surface at rest.
/// @param placement  begins at a cycle of the driven robot, as beginOf() found it
ClosedLoopEpisode runEpisode(const DrivenRobot& driven, const ObstaclePlacement& placement,
                             const ClosedLoopOptions& options, const EpisodeKind& kind);

/// Runs one placement with a robot that rests where the driven one is when the placement ends.
ClosedLoopEpisode runEpisodeAtRest(const DrivenRobot& driven, const ObstaclePlacement& placement,
                                   const ClosedLoopOptions& options, const EpisodeKind& kind);

}  // namespace sweep_guard_evaluation
