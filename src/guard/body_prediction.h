#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "guard/path_checker.h"
#include "sweep_guard/guard/guard_options.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// A predicted motion of one body of the tool, among workpieces. What it refers to must outlive its test.
struct BodyPredictionRequest {
  const Tool& tool;
  const PredictedMotion& motion;
  /// Their frames are taken to stay where they are at the pose that the motion begins at, but for PredictedMotion::frames.
  const Workpieces& workpieces;
  const SweepPlan& plan;
  size_t body = 0;                           ///< index of `tool` among PoseWithFrames::bodies
  const AllowedPairs* allowed = nullptr;     ///< null: none
  const Intentions* intentions = nullptr;    ///< null: contact is meant nowhere
  const IntendedTouches* touches = nullptr;  ///< null: none
  ClosestApproaches* closest = nullptr;      ///< of the bodies predicted so far; null: it is the only one
};

/// Tests the predicted motion of one body against every workpiece, one sweep at a time. A workpiece whose test fails is
/// reported, and the others are tested. Consecutive workpieces share the sweeps of the body as in PathChecker. Keeps its buffers.
class BodyPrediction {
 public:
  explicit BodyPrediction(const GuardOptions& options)
      : checker_(options.sweep, options.horizon.reflex_step / 2, options.max_deviations) {}

  /// Begins a test in place of the one before.
  /// @param[out] prediction  overwritten; must outlive the test; its buffers are used again
  void begin(const BodyPredictionRequest& request, Prediction& prediction);
  bool done() const;
  /// Returns the workpiece that step() goes on with; null if it begins with the next.
  const Workpiece* underTest() const { return checker_.done() ? nullptr : inOrder(next_ - 1).get(); }
  /// Begins the test against the next workpiece, or tests one sweep, or one half of a sweep. Not if done().
  void step(Detector& detector);
  /// Reports the workpiece under test, and those that follow, as failed.
  void giveUp(const std::string& reason);

 private:
  void orderByPadding();
  const Workpieces& workpieces() const;
  const std::shared_ptr<const Workpiece>& inOrder(size_t place) const { return workpieces()[order_[place]]; }
  bool beginNext();
  bool place(const Workpiece& workpiece);
  void finish();

  PathChecker checker_;
  std::optional<BodyPredictionRequest> request_;
  Prediction* prediction_ = nullptr;
  Eigen::Isometry3d X_WB_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WM_ = Eigen::Isometry3d::Identity();  // of the workpiece under test, in a frame that rests
  std::optional<std::vector<PredictedFrame>> frame_;        // the same, of one that moves on its own
  std::vector<size_t> order_;                               // of the workpieces
  size_t next_ = 0;                                         // in this order
  size_t tested_ = 0;                                       // objects of the prediction
};

/// Tests a predicted motion of all bodies of a tool against every workpiece, as a guard with these options does if time is
/// not short: one sweep for every pose of the path. A workpiece whose detection fails is reported as a failure. An empty
/// path tests nothing.
/// @param bodies       of the tool, at least one, as for Guard
/// @param options      only `sweep`, `horizon.reflex_step`, `max_deviations` and `allowed` count; they are not checked
/// @param out_of_time  once it returns true, sweeps after the reflex interval are tested coarsely: a triangle counts as
///                     met if no plane of a volume separates it from the volume; null: never
Prediction predictContacts(Detector& detector, const std::vector<Tool>& bodies, const PredictedMotion& motion,
                           const Workpieces& workpieces, const GuardOptions& options,
                           const std::function<bool()>& out_of_time);

}  // namespace sweep_guard_core
