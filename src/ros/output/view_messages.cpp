#include "ros/output/view_messages.h"

#include <algorithm>

#include "ros/output/marker_shapes.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::ObjectView;

sweep_guard::TestedVolume volumeMsg(const sweep_guard_core::SweptVolume& volume_M) {
  sweep_guard::TestedVolume msg;
  msg.pose = toMsg(volume_M.box.X_MB);
  msg.half_extents = vectorMsg<geometry_msgs::Vector3>(volume_M.box.half_extents);
  for (const sweep_guard_core::HalfSpace& clip_B : volume_M.clips_B) {
    const Eigen::Vector3d& n = clip_B.normal();
    msg.clips.emplace_back().coef = {n.x(), n.y(), n.z(), -clip_B.offset()};
  }
  return msg;
}

std::vector<sweep_guard::TestedVolume> volumeMsgs(const std::vector<sweep_guard_core::SweptVolume>& volumes_M) {
  std::vector<sweep_guard::TestedVolume> msgs;
  msgs.reserve(volumes_M.size());
  for (const sweep_guard_core::SweptVolume& volume_M : volumes_M) msgs.push_back(volumeMsg(volume_M));
  return msgs;
}

ObjectView& viewOf(const sweep_guard_core::Workpiece& workpiece, std::vector<ObjectView>& objects) {
  const auto known = std::find_if(objects.begin(), objects.end(),
                                  [&](const ObjectView& object) { return object.mesh_id == workpiece.id; });
  if (known != objects.end()) return *known;
  ObjectView& object = objects.emplace_back();
  object.mesh_id = workpiece.id;
  object.revision = workpiece.revision;
  object.frame_id = workpiece.frame;
  object.of_camera = workpiece.of_camera ? 1 : 0;
  return object;
}

void addContact(const MarkerScene& scene, std::vector<ObjectView>& objects) {
  for (const sweep_guard_core::SweptObject& object : scene.contact->objects) {
    if (object.workpiece->of_other_tool) continue;
    ObjectView& view = viewOf(*object.workpiece, objects);
    if (view.revision != object.workpiece->revision) continue;
    view.touched = object.result.unintended();
    view.impacts = toMsg(*object.workpiece, object.result, *scene.tool).impacts;
  }
}

void addPredicted(const sweep_guard_core::Prediction& prediction, std::vector<ObjectView>& objects) {
  for (const sweep_guard_core::PredictedObject& object : prediction.objects) {
    if (object.workpiece->of_other_tool) continue;
    ObjectView& view = viewOf(*object.workpiece, objects);
    if (view.revision != object.workpiece->revision) continue;
    view.predicted = volumeMsgs(object.volumes_M);
    view.reflex = object.reflex;
    view.considered = object.considered;
  }
}

}  // namespace

sweep_guard::View toMsg(const MarkerScene& scene) {
  sweep_guard::View msg;
  msg.level = static_cast<std::uint8_t>(scene.warning.level);
  msg.held = scene.warning.held_since.has_value() ? 1 : 0;
  msg.held_since = toMsg(scene.warning.held_since.value_or(sweep_guard_core::Time()));
  msg.acknowledged = scene.warning.acknowledged ? 1 : 0;
  msg.pose = toMsg(scene.X_WT);
  for (const sweep_guard_core::BodyPose& body : scene.body_poses) msg.bodies.push_back(toMsg(body.X_WB));
  if (!scene.newest) return msg;
  msg.header.stamp = toMsg(scene.newest->end);
  for (const sweep_guard_core::SweptObject& object : scene.newest->objects) {
    if (object.workpiece->of_other_tool) continue;  // its frame is not in tf, and its own guard shows it
    ObjectView& view = viewOf(*object.workpiece, msg.objects);
    view.measured = volumeMsgs(object.result.volumes_M);
    view.allowed = object.result.allowedTriangles();
  }
  if (scene.contact && scene.warning.level == sweep_guard_core::WarningLevel::kContact) addContact(scene, msg.objects);
  if (!scene.prediction) return msg;
  addPredicted(*scene.prediction, msg.objects);
  for (size_t i = 0; i < scene.prediction->path.size(); ++i) {
    msg.path.push_back(toMsg(scene.prediction->path[i].X_WT));
    for (const auto& path : scene.prediction->body_paths) msg.body_path.push_back(toMsg(path[i].X_WT));
  }
  return msg;
}

sweep_guard::ToolShape toMsg(const std::vector<sweep_guard_core::Tool>& bodies) {
  sweep_guard::ToolShape msg;
  for (size_t body = 0; body < bodies.size(); ++body) {
    for (const sweep_guard_core::ConvexPiece& piece : bodies[body].pieces()) {
      const sweep_guard_core::TriangleMesh& mesh_B = piece.shape_T.mesh_T();
      shape_msgs::Mesh& surface = msg.parts.emplace_back();
      for (size_t i = 0; i < mesh_B.vertexCount(); ++i) surface.vertices.push_back(point(mesh_B.vertex(i)));
      for (const auto& [a, b, c] : mesh_B.triangles()) surface.triangles.emplace_back().vertex_indices = {a, b, c};
      msg.links.push_back(piece.link);
      msg.bodies.push_back(static_cast<std::uint32_t>(body));
    }
  }
  return msg;
}

}  // namespace sweep_guard_ros
