#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "guard/intended_contact.h"
#include "sweep_guard/guard/guard_options.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Keeps how near a tool comes to a workpiece along a predicted path: the least deviations (PredictedSweep) by the time
/// when the sweeps begin. A sweep that comes no nearer than one that begins earlier changes no probability.
class ClosestApproach {
 public:
  void clear() { falls_.clear(); }
  void add(Duration from, double deviations);
  /// Returns the least deviations of the sweeps that begin at `from` or earlier; infinite if there are none.
  double upTo(Duration from) const;

 private:
  std::vector<std::pair<Duration, double>> falls_;  // ascending in time, falling in deviations
};

/// Keeps the closest approaches to several workpieces, for all bodies of a tool. Keeps its buffers.
class ClosestApproaches {
 public:
  void clear() { used_ = 0; }
  /// Returns the approach to a workpiece; the reference stays valid until clear().
  ClosestApproach& to(const Workpiece& workpiece);

 private:
  std::deque<std::pair<const Workpiece*, ClosestApproach>> approaches_;  // more than `used_` are buffers to use again
  size_t used_ = 0;
};

struct PredictionRequest {
  const Tool& tool;  ///< one body of it, unless it is only one
  const PredictedMotion& motion;
  /// Their frames are taken to stay where they are at the pose that the motion begins at, but for PredictedMotion::frames.
  const Workpieces& workpieces;
  const Intentions& intentions = kNoIntentions;
  const IntendedTouches& touches = kNoTouches;
  size_t body = 0;                       ///< index of `tool` among PoseWithFrames::bodies
  ClosestApproaches* closest = nullptr;  ///< of the bodies predicted so far; null: it is the only one
};

/// Tests a predicted motion against every workpiece, as a guard with these options does if time is not short: one sweep
/// for every pose of the path. A workpiece whose detection fails is reported as a failure. An empty path tests nothing.
/// @param bodies       of the tool, at least one, as for Guard
/// @param options      only `sweep`, `horizon.reflex_step` and `max_deviations` count; they are not checked
/// @param out_of_time  once it returns true, sweeps after the reflex interval are tested coarsely: a triangle counts as
///                     met if no plane of a volume separates it from the volume; null: never
Prediction predictContacts(Detector& detector, const std::vector<Tool>& bodies, const PredictedMotion& motion,
                           const Workpieces& workpieces, const GuardOptions& options,
                           const std::function<bool()>& out_of_time);

}  // namespace sweep_guard_core
