#include "rviz/workpieces.h"

#include <algorithm>

namespace sweep_guard_rviz {

void Workpieces::clear() {
  visuals_.clear();
  wrong_.clear();
  vertices_.clear();
}

WorkpieceVisual& Workpieces::visual(const std::string& id) {
  std::unique_ptr<WorkpieceVisual>& visual = visuals_[id];
  if (!visual) visual = std::make_unique<WorkpieceVisual>(scene_, node_);
  return *visual;
}

void Workpieces::note(const std::string& id, const std::string& wrong) {
  wrong_.erase(id);
  if (!wrong.empty()) wrong_[id] = wrong;
}

void Workpieces::take(const sweep_guard::DeformableMesh& mesh) {
  vertices_.erase(mesh.id);
  wrong_.erase(mesh.id);
  if (mesh.mesh.vertices.empty() && mesh.mesh.triangles.empty()) {
    visuals_.erase(mesh.id);
  } else {
    note(mesh.id, visual(mesh.id).setMesh(mesh));
  }
}

void Workpieces::take(const sweep_guard::MeshVertices::ConstPtr& vertices) { vertices_[vertices->id] = vertices; }

void Workpieces::deform() {
  for (const auto& [id, vertices] : vertices_) {
    const auto known = visuals_.find(id);
    note(id, known != visuals_.end() ? known->second->setVertices(*vertices) : "its triangles have not come");
  }
  vertices_.clear();
}

void Workpieces::draw(const std::vector<sweep_guard::ObjectView>& objects, const Look& look) {
  std::map<std::string, const sweep_guard::ObjectView*> views;
  for (const sweep_guard::ObjectView& object : objects) {
    views[object.mesh_id] = &object;
    visual(object.mesh_id);
  }
  for (auto each = visuals_.begin(); each != visuals_.end();) {
    WorkpieceVisual& visual = *each->second;
    const auto view = views.find(each->first);
    if (view == views.end() && !visual.hasMesh()) {
      each = visuals_.erase(each);
      continue;
    }
    visual.paint(look);
    view != views.end() ? visual.show(*view->second, look) : visual.showSurfaceOnly();
    ++each;
  }
}

void Workpieces::place(const FindFrame& find) {
  Ogre::Vector3 position;
  Ogre::Quaternion rotation;
  for (const auto& [id, visual] : visuals_) {
    const bool found = !visual->frame().empty() && find(visual->frame(), position, rotation);
    visual->setVisible(found);
    if (found) visual->place(position, rotation);
  }
}

size_t Workpieces::drawnTriangles(SurfaceVisual::Layer layer) const {
  size_t count = 0;
  for (const auto& [id, visual] : visuals_) count += visual->drawnTriangles(layer);
  return count;
}

std::string Workpieces::complaint(const std::string& topic) const {
  if (!wrong_.empty()) return "'" + wrong_.begin()->first + "': " + wrong_.begin()->second;
  if (visuals_.empty()) return "none has come from " + topic;
  const auto missing = std::find_if(visuals_.begin(), visuals_.end(), [](auto& one) { return !one.second->hasMesh(); });
  return missing == visuals_.end() ? "" : "'" + missing->first + "' has not come from " + topic;
}

}  // namespace sweep_guard_rviz
