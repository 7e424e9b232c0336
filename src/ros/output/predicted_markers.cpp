#include "ros/output/predicted_markers.h"

#include <algorithm>

#include "ros/output/marker_shapes.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::WarningLevel;
using visualization_msgs::Marker;

constexpr int kGhosts = 10;

// Returns the largest distance that a corner of the tool's bounding box moves between two poses.
double largestMotion(const sweep_guard_core::Tool& tool, const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p_T = tool.bounds_T().corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    largest = std::max(largest, (to * p_T - from * p_T).norm());
  }
  return largest;
}

void fade(Marker& strip, const Eigen::Vector3d& p_W, const std_msgs::ColorRGBA& full, double share) {
  strip.points.push_back(point(p_W));
  strip.colors.push_back(full);
  strip.colors.back().a *= static_cast<float>(share);
}

std::vector<Eigen::Isometry3d> bodiesAt(const PredictedScene& scene, size_t pose) {
  const sweep_guard_core::Prediction& prediction = scene.prediction;
  if (prediction.body_paths.empty()) return {prediction.path[pose].X_WT};
  std::vector<Eigen::Isometry3d> X_WB;
  for (const sweep_guard_core::PredictedPath& path : prediction.body_paths) X_WB.push_back(path[pose].X_WT);
  return X_WB;
}

// By half of the thickness of one of them.
bool haveMoved(const std::vector<sweep_guard_core::Tool>& bodies, const std::vector<Eigen::Isometry3d>& before,
               const std::vector<Eigen::Isometry3d>& X_WB) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (largestMotion(bodies[i], before[i], X_WB[i]) >= 0.5 * bodies[i].bounds_T().sizes().minCoeff()) return true;
  }
  return false;
}

}  // namespace

void addGhosts(visualization_msgs::MarkerArray& array, const PredictedScene& scene) {
  const sweep_guard_core::PredictedPath& path = scene.prediction.path;
  std::vector<Eigen::Isometry3d> drawn;
  for (int i = 0; i < kGhosts && !path.empty(); ++i) {
    const sweep_guard_core::Duration due = path.back().ahead * (i + 1) / kGhosts;
    const auto pose =
        std::lower_bound(path.begin(), path.end(), due,
                         [](const auto& before, sweep_guard_core::Duration t) { return before.ahead < t; });
    const std::vector<Eigen::Isometry3d> X_WB = bodiesAt(scene, static_cast<size_t>(pose - path.begin()));
    if (!drawn.empty() && !haveMoved(scene.bodies, drawn, X_WB)) continue;
    drawn = X_WB;
    const std_msgs::ColorRGBA fading = color(0.45, 0.65, 1.0, 0.5 * (kGhosts - i) / kGhosts);
    addTool(array, {"predicted_tool", i, scene.fixed_frame, scene.prediction.stamp, unlessUnknown(scene.level, fading)},
            scene.bodies, X_WB);
  }
}

void addPredictedVolumes(visualization_msgs::MarkerArray& array, const PredictedScene& scene) {
  int index = 0;
  for (const sweep_guard_core::PredictedObject& object : scene.prediction.objects) {
    if (object.workpiece->of_other_tool) continue;
    Surface surface("predicted_volume", index++, object.workpiece->frame, scene.prediction.stamp, 0.0005);
    surface.paint(levelColor(scene.level, 0.03), levelColor(scene.level, 0.12));
    for (const sweep_guard_core::SweptVolume& volume_M : object.volumes_M) surface.add(volume_M);
    surface.moveInto(array);
  }
}

void addPredictedTriangles(visualization_msgs::MarkerArray& array, const PredictedScene& scene) {
  const double lift = 0.5 * scene.lift;  // half as high as contacts, which are drawn above
  int index = 0;
  for (const sweep_guard_core::PredictedObject& object : scene.prediction.objects) {
    if (object.workpiece->of_other_tool) continue;
    for (const auto& [level, triangles] :
         {std::pair{WarningLevel::kReflex, &object.reflex}, {WarningLevel::kConsidered, &object.considered}}) {
      const WarningLevel shown = scene.level == WarningLevel::kUnknown ? WarningLevel::kUnknown : level;
      Surface surface("predicted_triangles", index++, object.workpiece->frame, scene.prediction.stamp, lift);
      surface.paint(levelColor(shown, 0.8), levelColor(shown, 0.95));
      surface.add(object.workpiece->mesh_M, *triangles, lift);
      surface.moveInto(array);
    }
  }
}

void addTrail(visualization_msgs::MarkerArray& array, const sweep_guard_core::Trail& trail,
              const std::string& fixed_frame, WarningLevel level) {
  if (trail.points().size() < 2) return;  // one point is no line
  const sweep_guard_core::Time newest = trail.points().back().stamp;
  const double span = sweep_guard_core::toSeconds(newest - trail.points().front().stamp);
  Marker strip = marker("trajectory", 0, Marker::LINE_STRIP, fixed_frame, newest);
  strip.scale.x = 0.002;
  strip.color = unlessUnknown(level, color(0.9, 0.9, 0.9, 0.8));
  for (const sweep_guard_core::Trail::Point& past : trail.points()) {
    const double age = sweep_guard_core::toSeconds(newest - past.stamp);
    fade(strip, past.p_W, strip.color, span > 0.0 ? 1.0 - age / span : 1.0);
  }
  array.markers.push_back(std::move(strip));
}

void addPredictedTrail(visualization_msgs::MarkerArray& array, const PredictedScene& scene,
                       const Eigen::Vector3d& from_W) {
  const sweep_guard_core::PredictedPath& path = scene.prediction.path;
  if (path.empty()) return;
  Marker strip = marker("trajectory", 1, Marker::LINE_STRIP, scene.fixed_frame, scene.prediction.stamp);
  strip.scale.x = 0.003;
  strip.color = unlessUnknown(scene.level, color(0.45, 0.65, 1.0, 0.95));
  fade(strip, from_W, strip.color, 1.0);
  const double span = sweep_guard_core::toSeconds(path.back().ahead);
  for (const sweep_guard_core::PredictedPose& pose : path) {
    fade(strip, pose.X_WT.translation(), strip.color, 1.0 - 0.7 * sweep_guard_core::toSeconds(pose.ahead) / span);
  }
  array.markers.push_back(std::move(strip));
}

}  // namespace sweep_guard_ros
