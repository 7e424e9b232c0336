#include "guard/seen_share.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr size_t kLeastPlaces = 64;  // fewer say little: a tool hides places beside itself

}  // namespace

bool SeenShare::begin(const Workpieces& workpieces, const PoseWithFrames& pose) {
  cameras_.clear();
  bodies_.clear();
  share_ = 1.0;
  bool any = false;
  for (const auto& workpiece : workpieces) {
    any = any || workpiece->of_camera;
    const auto X_WF = pose.X_WM.find(workpiece->frame);
    if (!workpiece->free_space || X_WF == pose.X_WM.end()) continue;
    cameras_.push_back({X_WF->second.inverse(), workpiece->free_space.get()});
  }
  return any;
}

// Between two poses a point goes straight: what it leaves out is less than the error of the prediction.
void SeenShare::add(const BodyBoxes& body, const Eigen::Isometry3d& X_WB, const PredictedPath& path) {
  const std::vector<Eigen::Vector3d>& points_B = body.points_B();
  size_t places = 0;
  size_t seen = 0;
  for (size_t step = path.size(); step-- > 0;) {
    const Eigen::Isometry3d& from = step == 0 ? X_WB : path[step - 1].X_WT;
    for (size_t i = 0; i < points_B.size(); ++i) {
      const double time = evenlySpread(i + step, 3);
      const Eigen::Vector3d p_W = (1.0 - time) * (from * points_B[i]) + time * (path[step].X_WT * points_B[i]);
      if (isNear(p_W)) continue;
      ++places;
      seen += isSeen(p_W) ? 1 : 0;
    }
    if (places < kLeastPlaces) continue;
    share_ = std::min(share_, static_cast<double>(seen) / static_cast<double>(places));
    places = seen = 0;
  }
}

bool SeenShare::isNear(const Eigen::Vector3d& p_W) const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [&](const PlacedBody& body) { return body.boxes->isNear(body.X_BW * p_W); });
}

bool SeenShare::isSeen(const Eigen::Vector3d& p_W) const {
  return std::any_of(cameras_.begin(), cameras_.end(),
                     [&](const Camera& camera) { return camera.space->contains(camera.X_FW * p_W); });
}

}  // namespace sweep_guard_core
