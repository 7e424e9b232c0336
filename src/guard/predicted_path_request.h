#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "guard/closest_approach.h"
#include "guard/intended_contact.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// How to cut a predicted path into sweeps, and how long they may take.
struct SweepPlan {
  std::vector<size_t> sweep_ends;       ///< pose numbers from findSweepEnds(); empty: every pose ends a sweep
  std::function<bool()> out_of_time{};  ///< true once the time for the whole prediction is used up; empty: never

  size_t sweepCount(const PredictedPath& path) const { return sweep_ends.empty() ? path.size() : sweep_ends.size(); }
  /// Returns the number of the pose that a sweep begins at. The measured pose is number 0.
  size_t beginOf(size_t sweep) const { return sweep == 0 ? 0 : endOf(sweep - 1); }
  size_t endOf(size_t sweep) const { return sweep_ends.empty() ? sweep + 1 : sweep_ends[sweep]; }
};

/// A predicted path of one body of the tool, and a workpiece on it. What it refers to must outlive its test.
struct PredictedPathRequest {
  const Tool& tool;
  const Eigen::Isometry3d& X_WT;  ///< of the body, where the path begins
  const PredictedPath& path;      ///< at least one pose
  size_t reflex_sweeps;           ///< number of poses, from the first, within the reflex interval
  const Eigen::Isometry3d& X_WM;  ///< frame of the workpiece; taken to stay where it is, unless there is `frame`
  const std::shared_ptr<const Workpiece>& workpiece;
  const SweepPlan& plan;
  const AllowedPairs* allowed = nullptr;               ///< null: none
  const Intentions* intentions = nullptr;              ///< null: contact is meant nowhere
  const IntendedTouches* touches = nullptr;            ///< null: none
  const std::vector<PredictedFrame>* frame = nullptr;  ///< framePath() along `path`, of a frame that moves on its own
  ClosestApproaches* closest = nullptr;                ///< of the bodies of the tool; null: it is the only one
};

}  // namespace sweep_guard_core
