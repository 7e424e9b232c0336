#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/prediction/sent_command.h"

namespace sweep_guard_core {

/// The pose of the tool, predicted for a time after the newest observed pose.
struct PredictedPose {
  Duration ahead{};                                        ///< after the stamp of the newest observed pose, > 0
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< most likely pose [m]
  /// Covariance of its error: translation [m], then rotation vector [rad], both along the axes of W; symmetric,
  /// positive semi-definite.
  Matrix6d covariance = Matrix6d::Zero();
  /// Bound [m], >= 0, on the distance of a point, at any time since the pose before, from where it would be if the body
  /// moved as Motion says: for a body that joints move.
  double deviation_bound = 0.0;
};

/// Predicted poses, ascending in time. The path begins at the newest observed pose, which is not part of it.
using PredictedPath = std::vector<PredictedPose>;

template <typename Space>
class MotionChannel;
struct PoseSpace;

/// Options of PosePredictor and JointPredictor.
struct PredictorOptions {
  std::string predictor = "direct";  ///< one of predictorNames()
  /// Degrees of the polynomials of `polynomial`: x y z of the tool's origin along the axes of W, then rotation about
  /// the tool's own axes; each 0 to 5.
  std::array<int, 6> degree = {1, 1, 1, 1, 1, 1};
  std::array<bool, 6> constrained{};                 ///< axes, in the same order, along which no motion is predicted
  double forgetting_factor = 0.98;                   ///< of `polynomial`: weight relative to the next sample, in (0, 1]
  Duration window = std::chrono::milliseconds(300);  ///< of `polynomial`: drops older samples if enough are left; > 0
  double max_speed = 5.0;                            ///< largest predicted speed of the tool's origin [m/s], > 0
  double max_turn_rate = 20.0;                       ///< largest predicted turn rate [rad/s], > 0
};

/// Returns the names of the predictors: `polynomial` (fitted to the last poses), `constant_velocity` (that of the last
/// 50 ms), `hold` (the tool stays) and `direct` (a regression on recent velocities, learned while running).
const std::vector<std::string>& predictorNames();

/// Predicts the operator's motion from the observed poses [P, Sec. 3.2]. The covariance comes from the errors of its
/// own earlier predictions. Any thread may call it, one thread at a time.
class PosePredictor {
 public:
  /// @throws InvalidInput if an option is out of range
  explicit PosePredictor(const PredictorOptions& options);
  ~PosePredictor();
  PosePredictor(PosePredictor&&) noexcept;
  PosePredictor& operator=(PosePredictor&&) noexcept;

  /// Adds what goes to the robot, a pose or a twist; anything else is ignored. From the next pose on, `direct` predicts from it as
  /// well, with weights and a covariance of their own: after 1 s of commands, while they come (three periods, at least
  /// 20 ms) and unless three poses in a row are farther than three standard deviations from what the command had predicted 0.1 s before
  /// them, and than what the measured motion had; then again after 1 s. Without a command none of this is computed.
  /// @param command  finite, rotation orthonormal; not checked
  void command(const SentCommand& command);

  /// Adds the newest pose. A pose that is earlier than the previous one, or later by less than 0.5 ms, replaces the
  /// previous pose, whose stamp stays unless the pose is a jump. The fit restarts at this pose after a gap (more than
  /// 0.25 s, or three periods of slower poses, at most 1 s) and after a jump faster than the limits; the errors learned
  /// of the operator are kept.
  /// @param pose  finite, rotation orthonormal; not checked
  void observe(const StampedPose& pose);

  /// Predicts the poses after the newest observed one. The path is empty until a motion is known: two poses since the
  /// start, a gap, a jump or restart().
  /// @param ahead      times after the stamp of the newest observed pose, strictly ascending, > 0 (asserted)
  /// @param[out] path  overwritten; its buffers are used again
  void predict(const std::vector<Duration>& ahead, PredictedPath& path) const;

  /// Returns whether predict() predicts from the command, not from the measured poses alone.
  bool usesCommand() const;

  /// Forgets the poses, and keeps what was learned of the operator.
  void restart();

 private:
  std::unique_ptr<MotionChannel<PoseSpace>> channel_;
};

}  // namespace sweep_guard_core
