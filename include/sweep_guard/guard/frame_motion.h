#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/common/mutex.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// The pose of a frame M in the fixed frame W at one moment.
struct FramePose {
  Time stamp;
  Eigen::Isometry3d X_WM = Eigen::Isometry3d::Identity();  ///< finite, rotation orthonormal; not checked
  /// Bound [m], >= 0, on the distance of a point of the workpieces in M, at any time since the previous pose, from where it
  /// would be if M moved as Motion says.
  double deviation_bound = 0.0;
  /// It did not move here from the pose before: a static transform has changed.
  bool anew = false;
  bool left_out = false;  ///< poses between this one and the one before were dropped
};

/// The pose of a frame M, measured or predicted, at a time.
struct PredictedFrame {
  Duration ahead{};                                        ///< after the time that the motion is predicted from
  Eigen::Isometry3d X_WM = Eigen::Isometry3d::Identity();  ///< most likely pose [m]
  Matrix6d covariance = Matrix6d::Zero();                  ///< of its error, as PredictedPose::covariance
  double deviation_bound = 0.0;                            ///< as FramePose::deviation_bound
};

/// How a frame moves on its own: a body of another tool, whose guard measures and predicts it, or a frame that tf measures and nobody
/// predicts. Between two poses, measured or predicted, it moves as a Motion, to within their deviation bounds.
struct FrameMotion {
  std::vector<FramePose> measured;  ///< at least one; stamps ascend
  Time predicted_from;              ///< stamp at which `predicted` begins; means nothing without it
  /// Its first pose is the one at `predicted_from`, without error; empty: where the frame goes is not known.
  std::vector<PredictedFrame> predicted = {};
  /// Without a prediction: it goes on at velocity() for 2 s, and then rests. The standard deviation of its error, over all axes, is
  /// speed times time.
  bool goes_on = false;

  /// Returns the pose at a time: measured up to `predicted_from`, then predicted. For 0.25 s after its end, the prediction goes
  /// on at the velocity of its last step. Without a bound. Empty: before the first measured pose and after that, unless it `goes_on`.
  std::optional<PredictedFrame> at(Time time) const;

  /// Returns the velocity of its origin [m/s] and the angular velocity [rad/s], along the axes of W, over the last 20 ms or more of
  /// the measured poses; 0 if there are not two. After less time since it was placed anew, it is that from before, turned with it.
  Vector6d velocity() const;
};

/// The motions of frames by their names, none null.
using FrameMotions = std::map<std::string, std::shared_ptr<const FrameMotion>>;

/// Returns how a frame moves along a path: its pose at the begin and at each pose of the path. Empty if that is not known up to its
/// end.
/// @param begin   stamp at which the path begins
/// @param path    only its times count
/// @param radius  largest distance of a point of the workpiece from the origin of the frame [m], >= 0: their deviation bounds hold
///     for such points
std::optional<std::vector<PredictedFrame>> framePath(const FrameMotion& motion, Time begin, const PredictedPath& path,
                                                     double radius);

/// Keeps the newest motions of frames that move on their own. Any thread.
class FrameMotionStore {
 public:
  FrameMotionStore();

  /// Sets which frames there are whose names begin with `beginning`, and forgets the motions of others that do.
  void expect(const std::string& beginning, const std::set<std::string>& frames);
  /// Replaces motions. Those of frames that are not expected are left out.
  void set(const FrameMotions& motions);

  /// Adds poses of a frame that nobody predicts and that goes_on, in any order; of several at one time, the first counts. Kept is
  /// what forgetBefore() leaves: at most 8192 poses, of which the oldest but one goes first.
  void add(const std::string& frame, const std::vector<FramePose>& poses);
  /// Replaces the added poses of a frame from the first of these on. The frame did not move there; up to then it is in its old
  /// place.
  /// @param placed  at least one; stamps ascend
  void placeAnew(const std::string& frame, std::vector<FramePose> placed);
  /// Forgets what add() added of frames other than these.
  void keepOnly(const std::set<std::string>& frames);
  /// Lets add() forget poses from before the sweep of a pose of the tool, except what velocity() needs.
  /// @param pose   its stamp
  /// @param known  what was known of the frames at that sweep
  void forgetBefore(Time pose, const FrameMotions& known);

  std::shared_ptr<const FrameMotions> get() const;  ///< all motions
  /// Returns the motion of a frame; null if there is none.
  std::shared_ptr<const FrameMotion> find(const std::string& frame) const;
  bool expects(const std::string& frame) const;  ///< see expect()
  /// Returns the pose of a frame at a time; empty: not known.
  std::optional<Eigen::Isometry3d> at(const std::string& frame, Time time) const;
  /// Returns the newest measured pose of a frame; empty: there is none.
  std::optional<Eigen::Isometry3d> newest(const std::string& frame) const;

 private:
  FrameMotion motionOf(const std::string& frame) const SWEEP_GUARD_REQUIRES(mutex_);
  void replace(const std::string& frame, FrameMotion motion) SWEEP_GUARD_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::set<std::string> frames_ SWEEP_GUARD_GUARDED_BY(mutex_);
  std::shared_ptr<const FrameMotions> motions_ SWEEP_GUARD_GUARDED_BY(mutex_);
  std::set<std::string> added_ SWEEP_GUARD_GUARDED_BY(mutex_);              // frames of add()
  std::map<std::string, Time> needed_from_ SWEEP_GUARD_GUARDED_BY(mutex_);  // by frame, as forgetBefore()
};

}  // namespace sweep_guard_core
