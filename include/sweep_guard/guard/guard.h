#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/budget.h"
#include "sweep_guard/guard/outlook.h"
#include "sweep_guard/guard/path_test.h"
#include "sweep_guard/guard/sweep_test.h"
#include "sweep_guard/guard/way.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard {

/// Where the tool T is at a moment in the fixed frame W, and where every frame M that a workpiece lives in.
struct ToolPose {
  Time stamp;
  SteadyTime received;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  std::map<std::string, Eigen::Isometry3d> X_WM;  ///< by name of M; a frame whose transform is missing is left out
};

/// One workpiece that was swept, and what was found.
struct SweptObject {
  std::shared_ptr<const Workpiece> workpiece;
  /// Stamp of the pose that the sweep began at; times of impact count from it to the newest pose's. What an update of
  /// the mesh has met earlier has time 0.
  Time interval_start;
  SweepFindings findings;
};

/// One step of the guard: everything that happened up to a pose.
struct SweepReport {
  Time start;  ///< earliest begin of a sweep; equal to `end` at the first pose
  Time end;    ///< stamp of the pose
  /// Time that the poses span which had to wait, and were passed through on the way to this one; 0 if there were none.
  Duration backlog{};
  std::vector<SweptObject> objects;    ///< every workpiece swept, in the order they came; not met: no triangles
  Workpieces unplaced;                 ///< workpieces whose frame is not known at the pose: not swept
  std::vector<SweepFailure> failures;  ///< workpieces whose detection failed: not swept

  double margin() const;  ///< largest of the objects [m]
  bool contact() const;   ///< some object was met
  bool complete() const;  ///< every workpiece was swept, and there is one
};

/// Where the tool is expected to go from a pose on, not tested yet.
struct Forecast {
  ToolPose from;
  PredictedPath path;        ///< empty: the motion is not known yet
  size_t reflex_sweeps = 0;  ///< the first so many end within the reflex interval
};

/// Tests a forecast against workpieces; their frames are taken to stay as they are at the pose that it begins at.
/// @param[out] outlook  what was in it is replaced; one that is handed in again and again ceases to allocate
void lookAlong(const Forecast& forecast, const Workpieces& workpieces, PathTest& test, Detector& detector,
               const Tool& tool, const PathTest::Effort& effort, Outlook& outlook);

struct GuardOptions {
  SweepOptions sweep;
  PredictorOptions predictor;
  HorizonOptions horizon;
  Duration cycle = fromSeconds(1.0 / 15.0);  ///< time there is for a pose and the prediction after it, > 0
  /// What the cost of sweeping is measured on; never goes back.
  std::function<SteadyTime()> clock = std::chrono::steady_clock::now;

  PathTest::Options pathTest() const { return {sweep, horizon.reflex_step / 2}; }
};

/// What a guard is to go on with.
struct GuardChange {
  GuardOptions options;                    ///< its clock does not count: the one there is stays
  std::optional<Tool> tool;                ///< empty: the one there is
  std::unique_ptr<Detector> detector;      ///< null: the one there is
  std::optional<PosePredictor> predictor;  ///< of these options; empty: the one there is, and what it has learned
};

/// Sweeps the tool from pose to pose, so that no motion goes untested. What could not be swept is not skipped: after a
/// failure of the detector the way through every pose since is swept, after a missing transform the straight way from
/// the last pose that was known in that frame. The first sweep in a frame is a test of the pose alone. From the newest
/// pose on it sweeps along the path that the operator's motion lets expect [P, Sec. 3.2]. One thread.
///
/// Tool and frames move straight at constant speed in W, and turn about one axis at constant rate, between their poses.
/// The vertices of a workpiece go straight from one update to the next, at whatever pace. They do so between the stamps
/// of both: when an update comes, the tool's way is swept again from the earlier of them on, though no longer back than
/// 0.5 s, against a mesh that moves.
///
/// Legs from pose to pose that are swept at once are joined into a chord() as long as that bulges by no more than a
/// thousandth of the tool's extent: smooth motion takes one or two sweeps, a flick stays one. Times of impact stay
/// early.
class Guard {
 public:
  /// @throws InvalidInput if an option is out of range
  Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options);

  /// Takes in a pose of a backlog: the next sweep is to pass through it. Its frames should all be known at the pose
  /// that is swept to; what lives in others waits until they are known again.
  /// @param pose  its stamp must not lie before that of the pose before
  void pass(const ToolPose& pose);

  /// From the pose swept to last, through those passed since, to this one.
  /// @param pose  its stamp must not lie before that of the pose before
  /// @param[out] report  what was in it is replaced; one that is handed in again and again ceases to allocate
  void sweep(const ToolPose& pose, const Workpieces& workpieces, SweepReport& report);
  SweepReport sweep(const ToolPose& pose, const Workpieces& workpieces);

  /// Sweeps along the path predicted from the newest pose on. Frames of workpieces are taken to stay as they are there.
  /// The path is empty until a motion is known: two poses.
  /// @param age           of the newest pose now, >= 0
  /// @param[out] outlook  what was in it is replaced; one that is handed in again and again ceases to allocate
  void lookAhead(Duration age, const Workpieces& workpieces, Outlook& outlook);
  Outlook lookAhead(Duration age, const Workpieces& workpieces);

  /// Where the tool is expected to go from the newest pose on, at the configured steps. Cheap: nothing is tested.
  /// @param age  of the newest pose now, >= 0
  /// @param end  how far it is looked ahead from now on, > 0
  Forecast forecast(Duration age, Duration end) const;

  /// Begins anew, as if no pose had come.
  void forget();

  /// Goes on differently. The next sweep begins where the last one has ended: the way between two poses is swept by
  /// what there was before, or by what there is now.
  /// @param[in,out] change  is handed what it replaces, so that the caller may destroy it where that takes no one's
  /// time
  void adopt(GuardChange& change);

  const Tool& tool() const { return tool_; }

 private:
  struct Swept {
    // As it was then, and before that as long as the poses to come may be older: the stamps of meshes may run ahead.
    Workpieces deformations;
    std::uint64_t pose = 0;  // number of the pose swept to
    SweptBefore known = {};
    std::shared_ptr<const Workpiece> displaced_from = nullptr;
    Displacements displacements = {};  // from there to the newest deformation
  };

  void take(const ToolPose& pose);
  void sweepAll(const ToolPose& pose, const Workpieces& workpieces, SweepReport& report);
  void sweepObject(const std::shared_ptr<const Workpiece>& workpiece, SweptObject& object);
  Swept& sweptBefore(const std::shared_ptr<const Workpiece>& workpiece);
  size_t endOfMotion(size_t begin, size_t last) const;
  const std::vector<Motion>& motions_M(const Way& way, size_t first, size_t begin, size_t end);
  void forgetWhatIsGone(const Workpieces& workpieces);
  void shorten(const std::string& frame, Way& way) const;
  void chooseEffort(SteadyTime begin);

  Tool tool_;
  std::unique_ptr<Detector> detector_;
  GuardOptions options_;
  std::map<std::string, Way> ways_;     // by frame: the poses that may be swept again, and the newest
  std::map<std::string, Swept> swept_;  // by id
  std::uint64_t poses_ = 0;
  std::uint64_t swept_to_ = 0;         // number of the pose swept to last
  std::optional<Time> waiting_since_;  // stamp of the first pose passed since then
  PosePredictor predictor_;
  Budget budget_;
  PathTest path_test_;
  std::optional<Forecast> forecast_;  // from the newest pose swept to
  Horizon horizon_;                   // of it
  PathTest::Effort effort_;           // for it
  Waypoints waypoints_M_;             // of the stretch that is swept
  std::vector<Motion> motions_M_;     // of a part of it
  SweepTest sweep_test_;
  SweptBefore known_;  // while a sweep may still fail
};

}  // namespace sweep_guard
