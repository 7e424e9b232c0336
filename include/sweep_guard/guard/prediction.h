#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/kinematics/joint_trajectory.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// An interval of HorizonOptions. Both begin now.
enum class PredictionInterval { kReflex, kConsidered };

/// Returns the probability that the tool meets a workpiece within an interval, anywhere and on any way, if the predicted
/// path comes as near to the workpiece within that interval as `deviations` (PredictedSweep). Falls with the deviations;
/// 0 beyond kMaxDeviations. These are the frequencies on recorded motion (doc/tune.md).
double probabilityWithin(PredictionInterval interval, double deviations);

/// Returns the largest number of deviations that has at least this probability; -infinity if none has. The inverse of
/// probabilityWithin().
double deviationsAt(PredictionInterval interval, double probability);

/// Returns the probability within an interval at the deviations of which contactProbability() is `plane_probability`;
/// 1 if there are none.
double fromPlaneProbability(PredictionInterval interval, double plane_probability);

/// What a path is predicted from.
enum class PredictionSource {
  kMeasured,    ///< the measured motion alone
  kCommand,     ///< what goes to the robot, too
  kTrajectory,  ///< the trajectory under way
};

/// Returns `measured`, `command` or `trajectory`.
const char* textOf(PredictionSource source);

/// The predicted motion of the tool after a pose, not yet tested for contacts.
struct PredictedMotion {
  PoseWithFrames from;       ///< newest measured pose; a default value before the first sweep
  PredictedPath path;        ///< empty if the motion is not known yet
  size_t reflex_sweeps = 0;  ///< number of poses in the reflex interval (HorizonOptions); meaningless without a path
  std::vector<PredictedPath> body_paths = {};              ///< of each body of an articulated tool, at the same times
  std::shared_ptr<const FrameMotions> frames = {};         ///< of those that move on their own; null: none
  std::shared_ptr<const JointTrajectory> trajectory = {};  ///< under way; null: none
  PredictionSource source = PredictionSource::kMeasured;

  const PredictedPath& pathOf(size_t body) const { return body_paths.empty() ? path : body_paths[body]; }
};

/// One sweep along the predicted path, or a fraction of a sweep, tested against one workpiece. Times count from the
/// stamp of the newest measured pose.
struct PredictedSweep {
  Duration from{};       ///< start; the sweep lasts until the next one begins or the path ends
  bool contact = false;  ///< a volume along the predicted path is not proven free; no narrow phase
  /// Number of standard deviations by which the tool must leave the path here to meet the workpiece; negative if the
  /// path meets it: to be free. 0 if, in the reflex interval, the volume meets it and the hull of the tool does not: the
  /// error of so short a prediction is smaller than the space that the volume leaves. Infinite beyond
  /// GuardOptions::max_deviations. May be infinite where the path meets nothing and comes no nearer than in a sweep that
  /// begins earlier: that changes no probability within an interval.
  double deviations = std::numeric_limits<double>::infinity();
  /// Index of the convex piece of the tool with these deviations; with `contact`, of those that meet the workpiece.
  /// Empty if there are none.
  std::optional<size_t> tool_piece = {};
};

/// The predicted contacts with one workpiece.
struct PredictedObject {
  std::shared_ptr<const Workpiece> workpiece;
  std::vector<PredictedSweep> sweeps;  ///< end to end, ascending; split if they may meet, up to the first contact
  std::vector<std::uint32_t> reflex;   ///< triangles met or not ruled out in the reflex interval: ascending, each once
  std::vector<std::uint32_t> considered;  ///< the same later: ascending, each once, none of `reflex`
  std::vector<SweptVolume>
      volumes_M;  ///< volumes around the whole tool, or around each of its bodies in turn, except bodies that
                  ///< stay out of reach of the workpiece: end to end, unsplit; in M
  size_t volumes_tested = 0;  ///< number of volumes tested in time, including those of split sweeps

  std::vector<std::uint32_t> triangles() const;  ///< of `reflex` and `considered`: ascending, each once
  std::optional<Duration> firstContact() const;  ///< start of the first sweep with contact; empty: none
  /// Returns the probability that the tool meets the workpiece within an interval.
  /// @param end  of the interval, after the stamp of the newest measured pose
  double probability(PredictionInterval interval, Duration end) const;
  void clear();  ///< resets all fields and keeps the buffers
};

/// The predicted path of the tool after a pose, and the contacts along it.
struct Prediction {
  Time stamp;          ///< stamp of the newest measured pose, where the path begins; 0: nothing was predicted
  PredictedPath path;  ///< of T; empty if the motion is not known yet
  std::vector<PredictedPath> body_paths;  ///< as PredictedMotion::body_paths
  PredictionSource source = PredictionSource::kMeasured;
  size_t reflex_sweeps = 0;  ///< number of sweeps, from the first, in the reflex interval; means nothing without a path
  size_t sweeps_asked = 0;   ///< one for every pose of the path
  size_t sweeps_made = 0;    ///< fewer if time was short: one sweep then covers several poses
  std::vector<PredictedObject> objects;  ///< every workpiece tested; none if the path is empty
  /// Workpieces not tested because their frame is unknown at the newest pose, or of one that moves on its own, to the end.
  Workpieces unplaced;
  std::vector<SweepFailure> failures;  ///< workpieces whose test failed, for one body at least
  /// Share of what the tool takes up that cameras see to be free, in the part of the path of which they see the least (SeenShare), 0 to
  /// 1; empty: there is no camera, or no path.
  std::optional<double> seen = {};

  /// Returns the stamp up to which every workpiece is tested: the end of the path, or `stamp` if the path is empty or a
  /// workpiece was not tested.
  Time coveredUntil() const;
  bool complete() const;  ///< the motion is known, there is a workpiece, and every workpiece was tested
  /// Returns the largest probability of a workpiece, not that of their union; 0 without a workpiece.
  double probability(PredictionInterval interval, Duration end) const;
  std::optional<Duration> firstContact() const;  ///< earliest one of all objects, counted from `stamp`
};

}  // namespace sweep_guard_core
