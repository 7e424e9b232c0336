#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/guard_options.h"
#include "sweep_guard/guard/intention.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

struct Detectors;
class DisplacementCache;
struct GuardedBody;
class PredictionRun;
struct SweepSetup;
class TimeBudget;

/// Sweeps the tool, or each body of it, from pose to pose, so that no motion goes untested, and predicts contacts after the
/// newest pose [P, Sec. 3.2]. Any thread may call it, one thread at a time; stop() at any time.
///
/// After a failure of the detector the next sweep passes through every pose since the last success. Of more than 8192
/// poses that wait, it goes straight past the oldest ones. After a missing transform it goes straight from the last
/// pose known in that frame. The first sweep in a frame begins at the first pose known there; if no pose was passed
/// before, it is a static test.
///
/// Between poses, tool and frames move straight at constant speed in W and turn about one axis at constant rate.
/// Between updates of a mesh, its vertices move straight at any speed. The update is a motion between the stamps of
/// both meshes: the tool's path since the earlier stamp is swept again against the moving mesh, as far as its poses are
/// kept. Swept poses are kept for 0.5 s. An update with other triangles in the same frame is no motion: the tool's path since the
/// last sweep is swept against the triangles from before and against the new ones.
///
/// What a camera saw (Workpiece::of_camera) is no motion as a whole. From image to image, the tool's path since the earlier stamp
/// is swept again against what the earlier image shows, at rest, and against the way of each vertex to the later one. `halfspace`
/// tests it, whatever the detector.
///
/// Of several poses swept at once, consecutive segments are replaced by one straight motion where no tool point
/// deviates by more than a thousandth of the tool's bounding radius and the rotation is at most `max_rotation`. The
/// margin grows by the deviation, so times of impact are never late.
class Guard {
 public:
  /// @param detector  not null; not checked
  /// @throws InvalidInput if `cycle` or an option of the predictor or the horizon is out of range; `options.sweep` is
  ///     not checked
  Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options);
  /// Guards the bodies of a robot, whose joints move them: they share detector, time and report. The motion of the joints
  /// is predicted, see MotionPredictor.
  /// @param robot  with at least one body, not null; their pieces are counted through
  Guard(const std::shared_ptr<const Robot>& robot, std::unique_ptr<Detector> detector, const GuardOptions& options);
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  /// Adds a pose that the next sweep passes through. A workpiece whose frame is missing at the pose of the sweep is
  /// reported as unplaced. Once its frame is known again, it is swept through the added poses that hold its frame.
  /// @param pose  finite, rotations orthonormal, stamp not earlier than the previous pose's (not checked), PoseWithFrames::bodies
  ///     as many as the robot's, with its state; one, at `X_WT`, without a robot (asserted). After time went back, call reset() first.
  ///     Where a static transform has changed: first the pose in the old placement, 1 ns earlier, then the poses of the way to it in
  ///     the new one, with its stamp and PoseWithFrames::anew, then the pose itself in the new one
  void pass(const PoseWithFrames& pose);

  /// Sweeps from the pose of the last sweep, through the poses passed since, to this pose. If the detector fails or
  /// memory runs out during a workpiece, the report names the workpiece, and the others are swept. Throws only
  /// std::bad_alloc, outside of the sweeps.
  /// @param pose  as for pass(). Where it places the frames of follow(), see placeFollowed(), counts after the sweep: for contact as
  ///     intended, isWithin() and the order in which bodies are predicted
  /// @param[out] report  overwritten; its buffers are used again
  /// @param arrived  false: `pose` is that of the last sweep (its stamp is asserted), placed by placeFollowed() once more, and no pose
  ///     was passed since (not checked). Sweeps on against the workpieces in frames of follow() that are known further than then; the
  ///     others are tested where the tool stands
  void sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report, bool arrived = true);

  /// Sets how frames move on their own, from the next pass(), sweep() and predict() on: PoseWithFrames::X_WM does not count for
  /// them. Their workpieces are swept up to the older of the newest poses of frame and tool, and predicted along the motion
  /// of the frame. Each call continues the motions of the one before.
  /// @param frames  not null
  void follow(std::shared_ptr<const FrameMotions> frames) { frames_ = std::move(frames); }

  /// Adds what goes to the robot: from the next pose on, its motion is predicted from it (PosePredictor::command()).
  /// @param command  finite, rotation orthonormal, CommandedJoints as many as the joints of the robot; not checked
  void command(const SentCommand& command) { predictor_.command(command); }

  /// Sets the trajectory that the joints follow, for predictions from the next one on: see MotionPredictor.
  /// @param trajectory  of the joints of the robot (not checked); null: none is known
  void setTrajectory(std::shared_ptr<const JointTrajectory> trajectory) { trajectory_ = std::move(trajectory); }

  /// Takes the last sweep back, because its report was lost or sweep() threw: the next one begins where it began. Not
  /// after later calls of pass().
  void takeBack() noexcept;

  /// Predicts the path after the newest pose and tests it. Frames of workpieces are taken to stay where they are, but for
  /// those of follow(). The newest pose must have been given to sweep(), not to pass(). The path is empty until
  /// PosePredictor knows a motion. The whole prediction is empty, without a stamp, before the first sweep and if `age`
  /// exceeds the reserve of the horizon: the number of sweeps would grow with the age. Fails and throws as sweep() does.
  ///
  /// If `cycle` leaves too little time after sweep(), sweeps beyond the reflex interval are fewer and coarser: they may
  /// report contacts that finer ones would rule out, but miss none.
  ///
  /// The caller drives the prediction step by step. Between two steps it may call sweep(), pass(), follow(), intend(),
  /// takeBack() and reset(), nothing else: the prediction goes on from the pose that it began with, and their time is not its
  /// time. It ends early when the next one begins.
  /// @param age         of the newest pose, >= 0 (asserted)
  /// @param workpieces  must outlive the run
  /// @param[out] prediction  overwritten; must outlive the run; its buffers are used again
  PredictionRun beginPrediction(Duration age, const Workpieces& workpieces, Prediction& prediction);

  /// Predicts in one go.
  void predict(Duration age, const Workpieces& workpieces, Prediction& prediction);

  /// Predicts the motion after the newest pose without testing it. The newest pose must have been given to sweep(), not
  /// to pass(). The path is empty before the first sweep and until PosePredictor knows a motion. Unlike predict(), this
  /// does not refuse an old pose.
  /// @param age  of the newest pose, >= 0 (asserted)
  /// @param end  of the prediction, counted from now, > 0 (asserted)
  PredictedMotion predictMotion(Duration age, Duration end) const;

  /// Returns whether the tool at the newest pose, grown by a distance, meets a workpiece other than allowed. False before the first sweep,
  /// and if the frame of the workpiece is not known at that pose.
  /// @param distance  [m], >= 0; not checked
  /// @throws DeviceError if the detector fails
  bool isWithin(double distance, const Workpiece& workpiece);

  /// Sets where contact is meant, from the next sweep and the next prediction on. Contact as intended is reported apart
  /// (SweepResult::intended) and is not predicted. After a link has touched a workpiece as intended, other contact of the
  /// two is predicted only where the predicted path itself meets the workpiece, not where it is merely probable. That ends
  /// once the link is 10 mm away from the box around the regions that it may touch, may touch none any more, or the
  /// workpiece is not swept. Without narrow phase (SweepOptions::fine), nothing is intended.
  /// @param intentions  not null
  void intend(std::shared_ptr<const Intentions> intentions);
  /// Returns where contact is meant: nowhere without narrow phase.
  const std::shared_ptr<const Intentions>& intentions() const;

  /// Forgets all poses and contacts, and keeps what the predictor has learned of the operator.
  void reset();

  /// Exchanges the options except the clock, and bodies, detector or predictor if given. The next sweep begins where the
  /// last one ended.
  /// @param[in,out] change  receives what it replaces, so that the caller may destroy it in another thread
  /// @throws InvalidInput if `cycle` or an option of the horizon is out of range; then nothing is exchanged
  void exchange(GuardChange& change);

  /// Gives up the running sweep or prediction and all later ones soon: they report failures. Any thread.
  void stop() { stopping_ = true; }

  /// Returns one body of the tool.
  const Tool& tool(size_t body = 0) const;

 private:
  class Run;
  friend class PredictionRun;

  Guard(std::vector<Tool> bodies, std::shared_ptr<const Robot> robot, std::unique_ptr<Detector> detector,
        const GuardOptions& options);

  void observe(const PoseWithFrames& pose);
  SweepSetup sweepSetup(const GuardedBody& body) const;
  void throwIfStopping() const;

  std::atomic<bool> stopping_ = false;
  std::vector<std::unique_ptr<GuardedBody>> bodies_;
  std::unique_ptr<Detectors> detectors_;
  std::unique_ptr<DisplacementCache> displacements_;
  GuardOptions options_;
  MotionPredictor predictor_;
  std::unique_ptr<TimeBudget> budget_;
  std::optional<PoseWithFrames> newest_;  // pose of the last sweep
  std::string jump_;                      // what jumped since then, in words
  std::unique_ptr<Run> run_;
  const std::shared_ptr<const Intentions> no_intentions_;
  std::shared_ptr<const Intentions> intentions_;
  std::shared_ptr<const FrameMotions> frames_ = std::make_shared<const FrameMotions>();
  std::shared_ptr<const JointTrajectory> trajectory_;
};

/// A prediction under way. Its Guard must outlive it.
///
///     for (PredictionRun run = guard.beginPrediction(age, workpieces, prediction); !run.done();) {
///       run.step();
///       if (a pose has come) guard.sweep(...);
///     }
class PredictionRun {
 public:
  bool done() const;  ///< the prediction is complete
  /// Begins the test of one body against one workpiece, or tests one sweep of it, or a half of a sweep. Not if done().
  void step();

 private:
  friend class Guard;
  explicit PredictionRun(Guard::Run& run) : run_(run) {}

  Guard::Run& run_;
};

}  // namespace sweep_guard_core
