#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/matrix6.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Where the tool is expected to be some time after the newest pose observed. (The message of it is PredictedPose.)
struct PredictedPose {
  Duration ahead{};                                        ///< after the stamp of the newest pose observed, > 0
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the best guess
  /// Of its error: translation [m], then rotation vector [rad], both along the axes of W; symmetric, positive
  /// semi-definite.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Ascending in time. It begins at the newest pose observed, which is no part of it.
using PredictedPath = std::vector<PredictedPose>;

struct PredictorOptions {
  std::string predictor = "direct";  ///< one of predictorNames()
  /// Of the polynomials of `polynomial`: x y z of the tool's origin along the axes of W, then rotation about the tool's
  /// own axes; each 0 to 5.
  std::array<int, 6> degree = {1, 1, 1, 1, 1, 1};
  std::array<bool, 6> constrained{};                 ///< axes, in the same order, that no predictor moves
  double forgetting_factor = 0.98;                   ///< weight of a sample over that of the next one, in (0, 1]
  Duration window = std::chrono::milliseconds(300);  ///< no older sample counts; > 0
  double max_speed = 5.0;                            ///< of the tool's origin [m/s], > 0: no prediction is faster
  double max_turn_rate = 20.0;                       ///< [rad/s], > 0: no prediction turns faster
};

/// The names of the predictors: `polynomial`, `constant_velocity`, `hold`, `direct`.
const std::vector<std::string>& predictorNames();

/// Predicts the operator's motion from the poses so far [P, Sec. 3.2], and how far it errs: the covariance comes from
/// the errors that its own predictions turned out to have. One thread.
class PosePredictor {
 public:
  /// @throws InvalidInput if an option is out of range
  explicit PosePredictor(const PredictorOptions& options);
  ~PosePredictor();
  PosePredictor(PosePredictor&&) noexcept;
  PosePredictor& operator=(PosePredictor&&) noexcept;

  /// Takes in the newest pose. A pose whose stamp is not later than that of the pose before replaces it. After a gap
  /// (0.25 s, or three periods of slower poses, 1 s at most) or a jump faster than the limits the fit begins anew; what
  /// was learned of the operator is kept.
  void observe(const StampedPose& pose);

  /// The poses expected after the newest one observed; empty until a motion is known: two poses since the start or a
  /// gap.
  /// @param ahead      ascending, > 0
  /// @param[out] path  what was in it is replaced
  void predict(const std::vector<Duration>& ahead, PredictedPath& path) const;
  PredictedPath predict(const std::vector<Duration>& ahead) const;

  /// Begins anew, as if no pose had come; what was learned of the operator is kept.
  void restart();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sweep_guard_core
