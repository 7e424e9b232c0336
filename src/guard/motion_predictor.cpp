#include "sweep_guard/guard/motion_predictor.h"

#include "prediction/profile.h"

namespace sweep_guard_core {

void MotionPredictor::observe(const PoseWithFrames& pose) {
  tool_.observe({pose.stamp, pose.X_WT});
  while (bodies_.size() < pose.bodies.size()) bodies_.emplace_back(options_);
  for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i].observe({pose.stamp, pose.bodies[i].X_WB});
}

void MotionPredictor::predict(const std::vector<Duration>& ahead, PredictedMotion& motion) const {
  tool_.predict(ahead, motion.path);
  motion.body_paths.resize(bodies_.size());
  bool known = !motion.path.empty();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].predict(ahead, motion.body_paths[i]);
    known = known && !motion.body_paths[i].empty();
  }
  if (known) return;
  motion.path.clear();
  for (PredictedPath& path : motion.body_paths) path.clear();
}

void MotionPredictor::restart() {
  tool_.restart();
  for (PosePredictor& body : bodies_) body.restart();
}

std::unique_ptr<Profile> MotionPredictor::profile() const { return tool_.profile(); }

}  // namespace sweep_guard_core
