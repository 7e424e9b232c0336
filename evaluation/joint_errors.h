#pragma once

#include <string>
#include <vector>

#include "sweep_guard/kinematics/joint_timeline.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::StampedPositions;

struct JointErrorRequest {
  const sweep_guard_core::KinematicTree& tree;
  const std::vector<size_t>& links;                  ///< whose origins are compared; indices in the tree
  const std::vector<StampedPositions>& states;       ///< stamps strictly ascending
  std::vector<sweep_guard_core::Duration> horizons;  ///< ascending, > 0
  sweep_guard_core::PredictorOptions predictor;
};

/// The errors of predictions of the origin of a link. NaN without samples.
class LinkErrors {
 public:
  void add(const sweep_guard_core::PredictedPose& predicted, const Eigen::Vector3d& found);

  size_t samples() const { return squares_.size(); }
  double distance(double share) const;  ///< quantile of the distance from where it came to be [m]
  /// Returns the standard deviation [m] of a ball whose volume is that of the covariance, at its geometric mean:
  /// exp(log det / 6). A millimeter is added to all deviations, since some links move in fewer than three directions.
  double width() const;
  /// Returns the same of the covariance scaled to hold 90 % of the errors.
  double calibratedWidth() const;

 private:
  std::vector<double> distances_;
  std::vector<double> squares_;  // of Mahalanobis distances
  double log_determinants_ = 0.0;
};

/// The prediction by joints and that of the pose of the link, on the same samples: those with 3 s before and the longest
/// horizon after them without a gap of 0.25 s. Earlier, nothing is learned, and many recordings begin at rest.
struct JointErrorReport {
  std::string link;
  sweep_guard_core::Duration horizon;
  LinkErrors by_joints;  ///< by MotionPredictor
  LinkErrors by_pose;    ///< by PosePredictor
};

/// Passes every state to both predictors and compares their predictions with the recording. The root rests.
/// @return for each link, by horizon
std::vector<JointErrorReport> compareJointPrediction(const JointErrorRequest& request);

/// Returns a CSV file with the columns recording,predictor,link,horizon_s,by,median_m,p90_m,width_m,calibrated_width_m,
/// samples, where `by` is `joints` or `pose`.
/// @param name  of the recording
std::string jointErrorCsv(const std::string& name, const std::string& predictor,
                          const std::vector<JointErrorReport>& reports, bool header);

}  // namespace sweep_guard_evaluation
