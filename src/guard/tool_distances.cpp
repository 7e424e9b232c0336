#include "guard/tool_distances.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr Duration kPeriodOfPair =
    std::chrono::microseconds(20);  // for each body and workpiece, which take about 0.05 us

// Infinite if its frame is not known.
double distanceTo(const Workpiece& workpiece, const PoseWithFrames& pose, const std::vector<const Tool*>& bodies) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto X_WM = pose.X_WM.find(workpiece.frame);
  if (X_WM == pose.X_WM.end()) return nearest;
  const Eigen::Isometry3d X_MW = X_WM->second.inverse();
  for (size_t i = 0; i < bodies.size(); ++i)
    nearest = std::min(nearest, boxDistance(*bodies[i], X_MW * pose.bodies[i].X_WB, workpiece.mesh_M));
  return nearest;
}

}  // namespace

double boxDistance(const Tool& body, const Eigen::Isometry3d& X_MB, const TriangleMesh& mesh_M) {
  const Eigen::AlignedBox3d& bounds_B = body.bounds_T();
  const Eigen::Vector3d center_M = X_MB * bounds_B.center();
  const Eigen::Vector3d half_M = X_MB.linear().cwiseAbs() * (0.5 * bounds_B.sizes());
  return mesh_M.bounds_M().exteriorDistance(Eigen::AlignedBox3d(center_M - half_M, center_M + half_M));
}

void ToolDistances::add(const PoseWithFrames& pose, const Workpieces& workpieces, SteadyTime now,
                        const std::vector<const Tool*>& bodies) {
  const Lock lock(mutex_);
  const Duration period = kPeriodOfPair * static_cast<int>(bodies.size() * workpieces.size());
  if (measured_ && now - *measured_ < period) return;
  measured_ = now;
  auto known = distances_.begin();
  for (const auto& workpiece : workpieces) {
    while (known != distances_.end() && known->first < workpiece->id) known = distances_.erase(known);
    const bool is_known = known != distances_.end() && known->first == workpiece->id;
    const double distance = distanceTo(*workpiece, pose, bodies);
    if (std::isfinite(distance)) {
      if (!is_known) known = distances_.insert(known, {workpiece->id, {distance, distance}});
      known->second = {distance, std::min(known->second.least, distance)};
    }
    if (known != distances_.end() && known->first == workpiece->id) ++known;
  }
  distances_.erase(known, distances_.end());
}

std::map<std::string, ToolDistances::Distance> ToolDistances::get() const {
  const Lock lock(mutex_);
  return distances_;
}

}  // namespace sweep_guard_core
