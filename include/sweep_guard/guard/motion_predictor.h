#pragma once

#include <memory>
#include <vector>

#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Predicts the motion of the tool frame and of each body of the tool by PosePredictor, each on its own.
class MotionPredictor {
 public:
  /// @throws InvalidInput as PosePredictor()
  explicit MotionPredictor(const PredictorOptions& options) : options_(options), tool_(options) {}

  /// Adds the newest pose, as PosePredictor::observe().
  /// @param pose  has as many bodies as the first one; not checked
  void observe(const PoseWithFrames& pose);

  /// Predicts the paths after the newest pose, as PosePredictor::predict().
  /// @param[out] motion  its paths are overwritten, all or none of them empty
  void predict(const std::vector<Duration>& ahead, PredictedMotion& motion) const;

  /// Forgets the poses, and keeps what was learned of the operator.
  void restart();

  /// Returns what was learned of the motion of the tool frame, see PosePredictor.
  std::unique_ptr<Profile> profile() const;

 private:
  PredictorOptions options_;
  PosePredictor tool_;
  std::vector<PosePredictor> bodies_;
};

}  // namespace sweep_guard_core
