#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluation/session_count.h"

namespace sweep_guard_evaluation {

/// The sessions of one recording.
struct RecordingSessions {
  std::string recording;
  double minutes = 0.0;                            ///< of the recording, without gaps
  std::vector<std::vector<SessionCount>> objects;  ///< by session, then as placed
};

SessionCount sumOf(const RecordingSessions& sessions);
SessionCount sumOf(const std::vector<RecordingSessions>& recordings);

/// An interval that holds a figure with a probability of 95 %.
struct Interval {
  double lower;
  double upper;
};

/// Resamples the sessions: each session of each recording gets as many objects as it had, drawn with replacement from
/// the objects of all sessions of the recording. Recordings with the same numbers of sessions and objects get the same
/// draws, so that two runs can be compared in pairs.
/// @param draw  number of the draw
std::vector<RecordingSessions> resampled(const std::vector<RecordingSessions>& recordings, size_t draw);

/// Returns the 95 % intervals of some figures by bootstrap over the objects: 1000 draws.
/// @param figures  of a draw; as many each time
std::vector<Interval> bootstrap(const std::function<std::vector<double>(size_t draw)>& figures);

}  // namespace sweep_guard_evaluation
