#include "session/session_start.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <map>
#include <string>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_session {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;

class StartReader {
 public:
  explicit StartReader(Time start) : start_(sweep_guard_ros::toMsg(start)) {}

  void take(const rosbag::MessageInstance& message) {
    if (const auto mesh = message.instantiate<sweep_guard::DeformableMesh>()) takeMesh(mesh);
    if (const auto vertices = message.instantiate<sweep_guard::MeshVertices>()) takeVertices(vertices);
    if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) takeTransforms(*transforms);
    if (const auto intend = message.instantiate<sweep_guard::Intend>()) takeIntend(*intend, message.getTime());
  }

  SessionStart result() const {
    SessionStart start;
    for (const auto& [id, mesh] : meshes_) start.meshes.push_back(mesh);
    for (const auto& [id, vertices] : vertices_) start.vertices.push_back(vertices);
    start.intends = intends_;
    const auto transforms = boost::make_shared<tf2_msgs::TFMessage>();
    for (const auto& [child, transform] : transforms_) transforms->transforms.push_back(transform);
    if (!transforms_.empty()) start.transforms.emplace_back(transforms);
    return start;
  }

 private:
  void takeVertices(const sweep_guard::MeshVertices::ConstPtr& vertices) {
    if (!vertices->positions.empty()) vertices_[vertices->id] = vertices;
  }

  // Without triangles it removes the workpiece.
  void takeMesh(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    vertices_.erase(mesh->id);
    meshes_.erase(mesh->id);
    if (!mesh->mesh.triangles.empty() || !mesh->refused.empty()) meshes_[mesh->id] = mesh;
  }

  void takeTransforms(const tf2_msgs::TFMessage& message) {
    for (const geometry_msgs::TransformStamped& transform : message.transforms) {
      transforms_[transform.child_frame_id] = transform;
    }
  }

  void takeIntend(sweep_guard::Intend intend, const ros::Time& recorded) {
    if (intend.triangles.empty() && intend.radius == 0.0) {
      const auto of_workpiece = [&intend](const auto& earlier) { return earlier->mesh_id == intend.mesh_id; };
      intends_.erase(std::remove_if(intends_.begin(), intends_.end(), of_workpiece), intends_.end());
      return;
    }
    const ros::Duration elapsed = start_ - recorded;
    if (!intend.duration.isZero() && intend.duration <= elapsed) return;
    if (!intend.duration.isZero()) intend.duration -= elapsed;
    intends_.push_back(boost::make_shared<const sweep_guard::Intend>(std::move(intend)));
  }

  ros::Time start_;
  std::map<std::string, sweep_guard::DeformableMesh::ConstPtr> meshes_;  // by id
  std::map<std::string, sweep_guard::MeshVertices::ConstPtr> vertices_;  // by id
  std::map<std::string, geometry_msgs::TransformStamped> transforms_;    // by child
  std::vector<sweep_guard::Intend::ConstPtr> intends_;
};

}  // namespace

// The player plays what was recorded at the start itself.
SessionStart readStart(const SessionFiles& files, const SessionTopics& topics, Time start) {
  StartReader reader(start);
  if (start <= files.begin()) return reader.result();
  std::vector<std::string> names = {kStaticTransformsTopic, kIntendTopic};
  if (!topics.mesh.empty()) names.insert(names.end(), {topics.mesh, topics.mesh_vertices});
  files.forEach(names, files.begin(), start - Duration(1),
                [&reader](const rosbag::MessageInstance& message) { reader.take(message); });
  return reader.result();
}

}  // namespace sweep_guard_session
