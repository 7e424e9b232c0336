#include "ros/output/markers.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <chrono>

#include "common/heartbeat.h"
#include "ros/output/marker_shapes.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::WarningLevel;
using visualization_msgs::Marker;

constexpr int kGhosts = 10;
constexpr char kWorkpieces[] = "workpieces";
constexpr auto kRenewal = std::chrono::milliseconds(250);  // half of what a marker lives

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

std::vector<Eigen::Isometry3d> bodiesAt(const sweep_guard_core::Prediction& prediction, size_t pose) {
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

// Adds `predicted_tool`: at most ten ghosts at even intervals, fading with time. Omits a ghost that has hardly moved.
void addGhosts(visualization_msgs::MarkerArray& array, const MarkerScene& scene, const std::string& fixed_frame) {
  const sweep_guard_core::PredictedPath& path = scene.prediction->path;
  std::vector<Eigen::Isometry3d> drawn;
  for (int i = 0; i < kGhosts && !path.empty(); ++i) {
    const sweep_guard_core::Duration due = path.back().ahead * (i + 1) / kGhosts;
    const auto pose =
        std::lower_bound(path.begin(), path.end(), due,
                         [](const auto& before, sweep_guard_core::Duration t) { return before.ahead < t; });
    const std::vector<Eigen::Isometry3d> X_WB = bodiesAt(*scene.prediction, static_cast<size_t>(pose - path.begin()));
    if (!drawn.empty() && !haveMoved(*scene.bodies, drawn, X_WB)) continue;
    drawn = X_WB;
    Marker ghost = marker("predicted_tool", i, Marker::CYLINDER, fixed_frame, scene.prediction->stamp);
    ghost.color = unlessUnknown(scene.warning.level, color(0.45, 0.65, 1.0, 0.5 * (kGhosts - i) / kGhosts));
    addTool(array, ghost, *scene.bodies, X_WB);
  }
}

// Adds `predicted_volume`: the faint boxes and planes of the predicted sweeps.
void addPredictedVolumes(visualization_msgs::MarkerArray& array, const MarkerScene& scene) {
  int index = 0;
  for (const sweep_guard_core::PredictedObject& object : scene.prediction->objects) {
    if (object.workpiece->of_other_tool) continue;
    SurfaceMarker surface("predicted_volume", index++, object.workpiece->frame, scene.prediction->stamp, 0.0005);
    surface.paint(levelColor(scene.warning.level, 0.03), levelColor(scene.warning.level, 0.12));
    for (const sweep_guard_core::SweptVolume& volume_M : object.volumes_M) surface.add(volume_M);
    surface.moveInto(array);
  }
}

// Adds `predicted_triangles`: contacts within the reflex interval in red, later ones in amber.
void addPredictedTriangles(visualization_msgs::MarkerArray& array, const MarkerScene& scene) {
  const double lift = 0.5 * liftOff(*scene.tool);  // half as high as contacts, which are drawn above
  int index = 0;
  for (const sweep_guard_core::PredictedObject& object : scene.prediction->objects) {
    if (object.workpiece->of_other_tool) continue;
    for (const auto& [level, triangles] :
         {std::pair{WarningLevel::kReflex, &object.reflex}, {WarningLevel::kConsidered, &object.considered}}) {
      const WarningLevel shown = scene.warning.level == WarningLevel::kUnknown ? WarningLevel::kUnknown : level;
      SurfaceMarker surface("predicted_triangles", index++, object.workpiece->frame, scene.prediction->stamp, lift);
      surface.paint(levelColor(shown, 0.8), levelColor(shown, 0.95));
      surface.add(object.workpiece->mesh_M, *triangles, lift);
      surface.moveInto(array);
    }
  }
}

// Adds `trajectory`: the path of the tip, measured (id 0) and predicted (id 1), fading with the time from now.
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
    fade(strip, past.value, strip.color, span > 0.0 ? 1.0 - age / span : 1.0);
  }
  array.markers.push_back(std::move(strip));
}

void addPredictedTrail(visualization_msgs::MarkerArray& array, const MarkerScene& scene,
                       const std::string& fixed_frame) {
  const sweep_guard_core::PredictedPath& path = scene.prediction->path;
  if (path.empty()) return;
  Marker strip = marker("trajectory", 1, Marker::LINE_STRIP, fixed_frame, scene.prediction->stamp);
  strip.scale.x = 0.003;
  strip.color = unlessUnknown(scene.warning.level, color(0.45, 0.65, 1.0, 0.95));
  fade(strip, scene.prediction_from_W, strip.color, 1.0);
  const double span = sweep_guard_core::toSeconds(path.back().ahead);
  for (const sweep_guard_core::PredictedPose& pose : path) {
    fade(strip, pose.X_WT.translation(), strip.color, 1.0 - 0.7 * sweep_guard_core::toSeconds(pose.ahead) / span);
  }
  array.markers.push_back(std::move(strip));
}

constexpr double kLineWidth = 0.001;   // [m]
constexpr double kTextHeight = 0.025;  // [m]

// Writes the level and each reason in its own line.
void addText(visualization_msgs::MarkerArray& array, Marker text, const sweep_guard_core::Warning& warning) {
  text.scale.z = kTextHeight;
  text.color = levelColor(warning.level, 0.95);
  text.text = boost::algorithm::replace_first_copy(warning.text, ": ", "\n");
  boost::algorithm::replace_all(text.text, "; ", "\n");
  array.markers.push_back(std::move(text));
}

// @param fits  otherwise a text says that it is not drawn
Marker workpieceMarker(const sweep_guard_core::Workpiece& workpiece, int id, sweep_guard_core::Time stamp, bool fits) {
  const int type = fits ? Marker::TRIANGLE_LIST : Marker::TEXT_VIEW_FACING;
  Marker drawn = marker(kWorkpieces, id, type, workpiece.frame, stamp);
  drawn.frame_locked = 1U;  // follows its frame until it is drawn anew
  sweep_guard_core::beat();
  if (fits) {
    drawn.color = workpieceColor(1.0);
    addSurface(drawn, workpiece.mesh_M);
    return drawn;
  }
  drawn.pose.position = point(workpiece.mesh_M.bounds_M().center());
  drawn.scale.z = kTextHeight;
  drawn.color = workpieceColor(0.95);
  drawn.text = "'" + sweep_guard_core::printable(workpiece.id) + "' is not drawn:\nmore than " +
               std::to_string(kMaxMarkedTriangles) + " triangles in all";
  return drawn;
}

// Returns a point behind the rear end.
Eigen::Vector3d textPosition(const sweep_guard_core::Tool& tool) {
  const Eigen::AlignedBox3d& box = tool.bounds_T();
  return {box.center().x(), box.center().y(), box.min().z() - 0.4 * box.sizes().z()};
}

std::vector<Eigen::Isometry3d> bodyPoses(const MarkerScene& scene) {
  if (scene.body_poses.empty()) return {scene.X_WT};
  std::vector<Eigen::Isometry3d> X_WB;
  for (const sweep_guard_core::BodyPose& body : scene.body_poses) X_WB.push_back(body.X_WB);
  return X_WB;
}

void addSweptVolumes(visualization_msgs::MarkerArray& array, const sweep_guard_core::SweepReport& report,
                     WarningLevel level) {
  int index = 0;
  for (const sweep_guard_core::SweptObject& object : report.objects) {
    if (object.workpiece->of_other_tool) continue;
    SurfaceMarker surface("swept_volume", index++, object.workpiece->frame, report.end, kLineWidth);
    surface.paint(levelColor(level, 0.25), levelColor(level, 0.8));
    for (const sweep_guard_core::SweptVolume& volume_M : object.result.volumes_M) surface.add(volume_M);
    surface.moveInto(array);
  }
}

void addContactTriangles(visualization_msgs::MarkerArray& array, const sweep_guard_core::SweepReport& report,
                         sweep_guard_core::Time stamp, double lift, bool held) {
  const double alpha = held ? 0.3 : 0.95;
  int index = 0;
  for (const sweep_guard_core::SweptObject& object : report.objects) {
    if (object.workpiece->of_other_tool) continue;
    SurfaceMarker surface("contact_triangles", index++, object.workpiece->frame, stamp, lift);
    surface.paint(color(1.0, 0.15, 0.1, alpha), color(1.0, 0.75, 0.7, alpha));
    surface.add(object.workpiece->mesh_M, object.result.not_ruled_out, lift);
    surface.moveInto(array);
  }
}

void addAllowedTriangles(visualization_msgs::MarkerArray& array, const sweep_guard_core::SweepReport& report,
                         double lift, WarningLevel level) {
  int index = 0;
  for (const sweep_guard_core::SweptObject& object : report.objects) {
    if (object.workpiece->of_other_tool) continue;
    SurfaceMarker surface("allowed_triangles", index++, object.workpiece->frame, report.end, lift);
    surface.paint(unlessUnknown(level, color(0.4, 0.55, 0.65, 0.6)), unlessUnknown(level, color(0.25, 0.35, 0.4, 0.6)));
    surface.add(object.workpiece->mesh_M, object.result.allowedTriangles(), lift);
    surface.moveInto(array);
  }
}

}  // namespace

const std::vector<std::string>& markerNamespaces() {
  static const std::vector<std::string> namespaces = {
      kWorkpieces,         "tool",           "swept_volume",     "contact_triangles",
      "allowed_triangles", "predicted_tool", "predicted_volume", "predicted_triangles",
      "trajectory",        "warning_text"};
  return namespaces;
}

Markers::Markers(std::string fixed_frame) : fixed_frame_(std::move(fixed_frame)) {}

visualization_msgs::MarkerArray Markers::draw(const MarkerScene& scene, sweep_guard_core::SteadyTime now) {
  visualization_msgs::MarkerArray array;
  addWorkpieces(array, scene, now);
  if (scene.newest) addMeasured(array, scene);
  if (scene.prediction) addPredicted(array, scene);
  const auto hidden = [&](const Marker& drawn) { return scene.namespaces.count(drawn.ns) == 0; };
  array.markers.erase(std::remove_if(array.markers.begin(), array.markers.end(), hidden), array.markers.end());
  deleteOld(array);
  return array;
}

bool isOfWarning(const MarkerScene& scene, const sweep_guard_core::WarningLimits& limits) {
  constexpr sweep_guard_core::Duration kDelay = std::chrono::milliseconds(100);  // of the newest pose
  if (!scene.contact || !limits.hold(scene.newest->end - scene.contact->end - kDelay)) return false;
  const auto& objects = scene.contact->objects;
  return std::any_of(objects.begin(), objects.end(), [&](const sweep_guard_core::SweptObject& object) {
    return object.workpiece->id == scene.warning.mesh_id && object.result.unintendedContact();
  });
}

void Markers::addWorkpieces(visualization_msgs::MarkerArray& array, const MarkerScene& scene,
                            sweep_guard_core::SteadyTime now) {
  eraseRemoved(scene.workpieces, workpieces_);
  size_t triangles = 0;
  for (const auto& workpiece : scene.workpieces) {
    if (workpiece->of_other_tool) continue;
    const size_t with_it = triangles + workpiece->mesh_M.triangles().size();
    const bool fits = with_it <= kMaxMarkedTriangles;
    if (fits) triangles = with_it;
    const auto [known, is_new] = workpieces_.try_emplace(workpiece->id, DrawnWorkpiece{next_workpiece_, {}, {}});
    if (is_new) ++next_workpiece_;
    DrawnWorkpiece& drawn = known->second;
    if (!is_new && drawn.received == workpiece->received && now - drawn.at < kRenewal) continue;
    drawn.received = workpiece->received;
    drawn.at = now;
    const sweep_guard_core::Time stamp =
        scene.newest ? std::max(scene.newest->end, workpiece->stamp) : workpiece->stamp;
    array.markers.push_back(workpieceMarker(*workpiece, drawn.id, stamp, fits));
  }
}

void Markers::addMeasured(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const {
  const WarningLevel level = scene.warning.level;
  const sweep_guard_core::Time stamp = scene.newest->end;
  Marker tool = marker("tool", 0, Marker::CYLINDER, fixed_frame_, stamp);
  tool.color = unlessUnknown(level, toolColor(0.8));
  addTool(array, tool, *scene.bodies, bodyPoses(scene));

  Marker text = marker("warning_text", 0, Marker::TEXT_VIEW_FACING, fixed_frame_, stamp);
  text.pose = toMsg(scene.X_WT * Eigen::Translation3d(textPosition(*scene.tool)));
  addText(array, std::move(text), scene.warning);

  addSweptVolumes(array, *scene.newest, level);
  addAllowedTriangles(array, *scene.newest, liftOff(*scene.tool), level);
  addTrail(array, scene.trail, fixed_frame_, level);
  if (scene.contact && level == WarningLevel::kContact) {
    addContactTriangles(array, *scene.contact, stamp, liftOff(*scene.tool), scene.warning.held_since.has_value());
  }
}

void Markers::addPredicted(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const {
  addGhosts(array, scene, fixed_frame_);
  addPredictedVolumes(array, scene);
  addPredictedTriangles(array, scene);
  addPredictedTrail(array, scene, fixed_frame_);
}

void Markers::deleteOld(visualization_msgs::MarkerArray& array) {
  std::set<Key> now_shown;
  for (const Marker& drawn : array.markers) now_shown.emplace(drawn.ns, drawn.id);
  for (const auto& [id, drawn] : workpieces_) now_shown.emplace(kWorkpieces, drawn.id);
  for (const auto& [ns, id] : shown_) {
    if (now_shown.count({ns, id}) != 0) continue;
    Marker old = marker(ns, id, Marker::CUBE, fixed_frame_, {});
    old.action = Marker::DELETE;
    array.markers.push_back(old);
  }
  shown_ = std::move(now_shown);
}

}  // namespace sweep_guard_ros
