#pragma once

#include <string>
#include <vector>

#include "evaluation/closed_loop_episode.h"
#include "evaluation/progress.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// What happened at the placements along one recording, with or without a guard.
struct ClosedLoopCount {
  std::string recording;  ///< name, and how surfaces that come by themselves meet the tool
  bool guarded = false;
  std::vector<ClosedLoopEpisode> episodes;
  std::vector<bool> near_misses;  ///< of each episode: without a guard the tool does not touch the surface
};

/// Runs placements along recorded motions, as placeObstacles() finds them on the path of the robot without a guard.
/// @param left_out  placements along a recording at which no episode can begin are added
std::vector<ClosedLoopCount> countClosedLoops(const std::vector<sweep_guard_recording::Recording>& recordings,
                                              const ClosedLoopOptions& options, size_t& left_out,
                                              const Progress& progress);

/// Returns the counts of all recordings together, one for each kind of surface and arm.
std::vector<ClosedLoopCount> summed(const std::vector<ClosedLoopCount>& counts);

/// Returns a CSV file with one line for each count. Columns:
///
/// | column | meaning |
/// |---|---|
/// | recording | name; "all": all of them; with ", surface comes": to a tool that moves as the hand or rests |
/// | guarded | 1: a motion guard is before the robot |
/// | placements | squares on the path or near it |
/// | contacts | of these, those that the tool touches |
/// | speed_at_contact_p95 | closing speed [m/s] |
/// | free_motion_changed | share of the commands without a surface within reach that were not passed on bit for bit |
/// | retreat_speed_kept_least | least share of the commanded velocity in any retreat |
/// | time_until_free_median | from the first command along the surface's normal until the gap has grown by 10 mm [s] |
/// | retreats | number of retreats |
/// | retreats_kept | share of these that kept 99 % of the commanded velocity |
/// | standoff_speed | largest closing speed at the standoff [m/s] |
/// | near_misses | placements that the tool does not touch without a guard |
/// | near_misses_slowed | share of these in which a command was changed |
/// | near_miss_path_kept_median | of the slowed ones: share of the commanded path |
/// | tool_speed_at_contact_p95 | as speed_at_contact_p95, of the tool alone [m/s] |
std::string closedLoopCsv(const std::vector<ClosedLoopCount>& counts);

/// Returns whether before surfaces at rest no guarded tool touched one, also in a retreat, none reached the standoff at
/// 1 mm/s or more, each retreat kept 99 % of its speed, and each command without a surface within reach was passed on bit
/// for bit.
bool keepsItsPromise(const std::vector<ClosedLoopCount>& counts);

/// Returns a table for the terminal.
std::string closedLoopTable(const std::vector<ClosedLoopCount>& counts);

}  // namespace sweep_guard_evaluation
