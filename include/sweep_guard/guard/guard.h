#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/guard/displacements.h"
#include "sweep_guard/guard/guard_options.h"
#include "sweep_guard/guard/path_checker.h"
#include "sweep_guard/guard/pose_history.h"
#include "sweep_guard/guard/sweep_report.h"
#include "sweep_guard/guard/time_budget.h"

namespace sweep_guard_core {

/// Sweeps the tool from pose to pose, so that no motion goes untested, and predicts contacts after the newest pose
/// [P, Sec. 3.2]. One thread.
///
/// After a failure of the detector the next sweep passes through every pose since the last success; after a missing
/// transform it goes straight from the last pose known in that frame. The first sweep in a frame is a static test.
///
/// Between poses, tool and frames move straight at constant speed in W and turn about one axis at constant rate. Between
/// updates of a mesh, its vertices move straight at any speed. The update is a motion between the stamps of both meshes:
/// the tool's path since the earlier stamp, at most 0.5 s, is swept again against the moving mesh.
///
/// Segments that are swept at once are merged (mergedMotion()) as long as the deviation bound stays below a thousandth
/// of the tool's bounding radius. Times of impact stay early.
class Guard {
 public:
  /// @throws InvalidInput if an option is out of range
  Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options);

  /// Adds a pose that the next sweep passes through. Workpieces whose frame is missing at the pose that is swept to wait
  /// until their frame is known again.
  /// @param pose  its stamp must not be earlier than the previous pose's
  void pass(const PoseWithFrames& pose);

  /// Sweeps from the pose of the last sweep, through the poses passed since, to this pose.
  /// @param pose  its stamp must not be earlier than the previous pose's
  /// @param[out] report  overwritten; its buffers are used again
  void sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report);
  SweepReport sweep(const PoseWithFrames& pose, const Workpieces& workpieces);

  /// Predicts the path after the newest pose and tests it. Frames of workpieces are taken to stay where they are. The
  /// path is empty until two poses are known.
  /// @param age  of the newest pose, >= 0
  /// @param[out] prediction  overwritten; its buffers are used again
  void predict(Duration age, const Workpieces& workpieces, Prediction& prediction);
  Prediction predict(Duration age, const Workpieces& workpieces);

  /// Predicts the motion after the newest pose without testing it.
  /// @param age  of the newest pose, >= 0
  /// @param end  of the prediction, counted from now, > 0
  PredictedMotion predictMotion(Duration age, Duration end) const;

  /// Forgets all poses.
  void reset();

  /// Exchanges options, tool, detector or predictor. The next sweep begins where the last one ended.
  /// @param[in,out] change  receives what it replaces, so that the caller may destroy it in another thread
  void exchange(GuardChange& change);

  const Tool& tool() const { return tool_; }

 private:
  struct Swept {
    // Newest last. Older ones stay while later poses may have older stamps: stamps of meshes may run ahead.
    Workpieces deformations;
    std::uint64_t pose = 0;  // number of the pose of the last sweep
    SweepCache cache = {};
    std::shared_ptr<const Workpiece> displaced_from = nullptr;
    Displacements displacements = {};  // from there to the newest one
  };

  void take(const PoseWithFrames& pose);
  void sweepAll(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report);
  void sweepObject(const std::shared_ptr<const Workpiece>& workpiece, SweptObject& object);
  Swept& sweptBefore(const std::shared_ptr<const Workpiece>& workpiece);
  size_t endOfMotion(size_t begin, size_t last) const;
  const std::vector<Motion>& motions_M(const PoseHistory& history, size_t first, size_t begin, size_t end);
  void forgetRemoved(const Workpieces& workpieces);
  void shorten(const std::string& frame, PoseHistory& history) const;
  void chooseSweepPlan(SteadyTime begin);

  Tool tool_;
  std::unique_ptr<Detector> detector_;
  GuardOptions options_;
  std::map<std::string, PoseHistory> histories_;  // by frame: the poses that may be swept again, and the newest
  std::map<std::string, Swept> swept_;            // by id
  std::uint64_t poses_ = 0;
  std::uint64_t swept_to_ = 0;         // number of the pose of the last sweep
  std::optional<Time> waiting_since_;  // stamp of the first pose passed since then
  PosePredictor predictor_;
  TimeBudget budget_;
  PathChecker path_checker_;
  std::optional<PredictedMotion> predicted_motion_;  // after the pose of the last sweep
  Horizon horizon_;
  SweepPlan plan_;
  Path path_M_;                    // of the segment under test
  std::vector<Motion> motions_M_;  // of a part of the segment
  SweepChecker sweep_checker_;
  SweepCache cache_;  // kept apart while the sweep may still fail
};

}  // namespace sweep_guard_core
