#include "guard/tool_distances.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>

namespace sweep_guard_core {
namespace {

constexpr Duration kPeriodOfPair =
    std::chrono::microseconds(20);  // for each body and workpiece, which take about 0.05 us

constexpr double kOtherUnit = 3.0;  // a foot is 0.30 m; no deformation is as large from one pose to the next

// Empty if its frame is not known.
std::optional<double> distanceTo(const Workpiece& workpiece, const PoseWithFrames& pose,
                                 const std::vector<const Tool*>& bodies) {
  const auto X_WM = pose.X_WM.find(workpiece.frame);
  if (X_WM == pose.X_WM.end()) return {};
  const Eigen::Isometry3d X_MW = X_WM->second.inverse();
  double nearest = std::numeric_limits<double>::infinity();
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
  if (!mutex_.tryLock()) return;
  const Lock lock(mutex_, std::adopt_lock);
  const Duration period = kPeriodOfPair * static_cast<int>(bodies.size() * workpieces.size());
  if (measured_ && now - *measured_ < period) return;
  measured_ = now;
  auto known = known_.begin();
  for (const auto& workpiece : workpieces) {
    while (known != known_.end() && known->first < workpiece->id) known = known_.erase(known);
    if (known == known_.end() || known->first != workpiece->id) known = known_.insert(known, {workpiece->id, {}});
    measure(distanceTo(*workpiece, pose, bodies), workpiece->mesh_M.bounds_M().sizes().maxCoeff(), known->second);
    ++known;
  }
  known_.erase(known, known_.end());
}

void ToolDistances::measure(std::optional<double> distance, double length, Known& known) {
  const bool other_unit = length > kOtherUnit * known.length || known.length > kOtherUnit * length;
  known.length = length;
  known.distance.now = distance;
  std::optional<double>& least = known.distance.least;
  if (other_unit) least.reset();
  if (distance && (!least || *distance < *least)) least = distance;
}

std::map<std::string, ToolDistances::Distance> ToolDistances::get() const {
  const Lock lock(mutex_);
  std::map<std::string, Distance> distances;
  for (const auto& [id, known] : known_) distances.emplace_hint(distances.end(), id, known.distance);
  return distances;
}

}  // namespace sweep_guard_core
