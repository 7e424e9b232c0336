#include "guard/sparse_motion.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {

void SparseMotion::add(Time stamp, const BodyPose& pose) {
  if (path_W_.empty()) {
    first_ = stamp;
    deviation_bound_ = 0.0;
    path_W_.push_back({Duration::zero(), pose.X_WB, 0.0});
    return;
  }
  const double turn = Motion{path_W_.back().X_MT, pose.X_WB}.angle();
  path_W_.push_back({stamp - first_, pose.X_WB, chordError(radius_, turn)});
  deviation_bound_ = std::max(deviation_bound_, pose.deviation_bound);
}

BodyPose SparseMotion::take() {
  assert(!path_W_.empty());
  BodyPose newest{path_W_.back().X_MT, deviation_bound_};
  if (path_W_.size() > 2)
    newest.deviation_bound += mergedMotion(path_W_, 0, path_W_.size() - 1, radius_).deviation_bound;
  first_ += path_W_.back().time;
  path_W_.assign(1, {Duration::zero(), newest.X_WB, 0.0});
  deviation_bound_ = 0.0;
  return newest;
}

}  // namespace sweep_guard_core
