#include "ros/output/markers.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>

#include "ros/output/marker_shapes.h"
#include "ros/output/predicted_markers.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::WarningLevel;
using visualization_msgs::Marker;

constexpr double kLineWidth = 0.001;  // [m]

// Writes the level and each reason in its own line.
void addText(visualization_msgs::MarkerArray& array, Marker text, const sweep_guard_core::Warning& warning) {
  text.scale.z = 0.025;
  text.color = levelColor(warning.level, 0.95);
  text.text = boost::algorithm::replace_first_copy(warning.text, ": ", "\n");
  boost::algorithm::replace_all(text.text, "; ", "\n");
  array.markers.push_back(std::move(text));
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
    Surface surface("swept_volume", index++, object.workpiece->frame, report.end, kLineWidth);
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
    Surface surface("contact_triangles", index++, object.workpiece->frame, stamp, lift);
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
    Surface surface("allowed_triangles", index++, object.workpiece->frame, report.end, lift);
    surface.paint(unlessUnknown(level, color(0.4, 0.55, 0.65, 0.6)), unlessUnknown(level, color(0.25, 0.35, 0.4, 0.6)));
    surface.add(object.workpiece->mesh_M, object.result.allowedTriangles(), lift);
    surface.moveInto(array);
  }
}

}  // namespace

const std::vector<std::string>& markerNamespaces() {
  static const std::vector<std::string> namespaces = {
      "tool",           "swept_volume",     "contact_triangles",   "allowed_triangles",
      "predicted_tool", "predicted_volume", "predicted_triangles", "trajectory",
      "warning_text"};
  return namespaces;
}

Markers::Markers(std::string fixed_frame) : fixed_frame_(std::move(fixed_frame)) {}

visualization_msgs::MarkerArray Markers::draw(const MarkerScene& scene) {
  visualization_msgs::MarkerArray array;
  if (scene.newest) addMeasured(array, scene);
  if (scene.prediction) addPredicted(array, scene);
  const auto hidden = [&](const Marker& drawn) { return scene.namespaces.count(drawn.ns) == 0; };
  array.markers.erase(std::remove_if(array.markers.begin(), array.markers.end(), hidden), array.markers.end());
  deleteOld(array);
  return array;
}

bool isOfWarning(const MarkerScene& scene, sweep_guard_core::Duration hold) {
  constexpr sweep_guard_core::Duration kDelay = std::chrono::milliseconds(100);  // of the newest pose
  if (!scene.contact || scene.newest->end - scene.contact->end > hold + kDelay) return false;
  const auto& objects = scene.contact->objects;
  return std::any_of(objects.begin(), objects.end(), [&](const sweep_guard_core::SweptObject& object) {
    return object.workpiece->id == scene.warning.mesh_id && object.result.unintendedContact();
  });
}

void Markers::addMeasured(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const {
  const WarningLevel level = scene.warning.level;
  const sweep_guard_core::Time stamp = scene.newest->end;
  addTool(array, {"tool", 0, fixed_frame_, stamp, unlessUnknown(level, color(0.35, 0.5, 0.9, 0.8))}, *scene.bodies,
          bodyPoses(scene));

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
  const PredictedScene predicted{*scene.prediction, *scene.bodies, liftOff(*scene.tool), fixed_frame_,
                                 scene.warning.level};
  addGhosts(array, predicted);
  addPredictedVolumes(array, predicted);
  addPredictedTriangles(array, predicted);
  addPredictedTrail(array, predicted, scene.prediction_from_W);
}

void Markers::deleteOld(visualization_msgs::MarkerArray& array) {
  std::set<Key> now_shown;
  for (const Marker& drawn : array.markers) now_shown.emplace(drawn.ns, drawn.id);
  for (const auto& [ns, id] : shown_) {
    if (now_shown.count({ns, id}) != 0) continue;
    Marker old = marker(ns, id, Marker::CUBE, fixed_frame_, {});
    old.action = Marker::DELETE;
    array.markers.push_back(old);
  }
  shown_ = std::move(now_shown);
}

}  // namespace sweep_guard_ros
