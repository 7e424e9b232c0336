#include "rviz/workpieces.h"

#include <algorithm>

namespace sweep_guard_rviz {

void Workpieces::clear() {
  visuals_.clear();
  cameras_.clear();
  problems_.clear();
  vertices_.clear();
  intended_.reset();
  touches_.reset();
}

WorkpieceVisual& Workpieces::visual(const std::string& id) {
  std::unique_ptr<WorkpieceVisual>& visual = visuals_[id];
  if (!visual) visual = std::make_unique<WorkpieceVisual>(scene_, node_);
  return *visual;
}

void Workpieces::setProblem(const std::string& id, const std::string& problem) {
  problems_.erase(id);
  if (!problem.empty()) problems_[id] = problem;
}

void Workpieces::take(const sweep_guard::DeformableMesh& mesh) {
  if (!mesh.refused.empty()) return setProblem(mesh.id, mesh.refused);
  vertices_.erase(mesh.id);
  problems_.erase(mesh.id);
  if (mesh.mesh.vertices.empty() && mesh.mesh.triangles.empty()) {
    visuals_.erase(mesh.id);
  } else {
    setProblem(mesh.id, visual(mesh.id).setMesh(mesh));
  }
}

void Workpieces::take(const sweep_guard::MeshVertices::ConstPtr& vertices) {
  if (!vertices->positions.empty()) vertices_[vertices->id] = vertices;
}

void Workpieces::deform() {
  for (const auto& [id, vertices] : vertices_) {
    const auto known = visuals_.find(id);
    setProblem(id, known != visuals_.end() ? known->second->setVertices(*vertices) : "no mesh yet");
  }
  vertices_.clear();
}

void Workpieces::draw(const std::vector<sweep_guard::ObjectView>& objects, const DisplayStyle& style) {
  std::map<std::string, const sweep_guard::ObjectView*> views;
  for (const sweep_guard::ObjectView& object : objects) {
    views[object.mesh_id] = &object;
    if (object.of_camera != 0) cameras_.insert(object.mesh_id);
    visual(object.mesh_id);
  }
  for (auto each = visuals_.begin(); each != visuals_.end();) {
    WorkpieceVisual& visual = *each->second;
    const auto view = views.find(each->first);
    if (view == views.end() && !visual.hasMesh()) {
      each = visuals_.erase(each);
      continue;
    }
    visual.paint(style);
    showIntended(each->first, visual);
    showTouches(each->first, visual, style.color_by);
    view != views.end() ? visual.show(*view->second, style) : visual.showSurfaceOnly();
    ++each;
  }
}

void Workpieces::showIntended(const std::string& id, WorkpieceVisual& visual) const {
  std::uint32_t revision = 0;
  std::vector<std::uint32_t> triangles;
  for (const sweep_guard::Intention& intention :
       intended_ ? intended_->intentions : sweep_guard::Intended().intentions) {
    if (intention.mesh_id != id) continue;
    revision = intention.revision;
    triangles.insert(triangles.end(), intention.triangles.begin(), intention.triangles.end());
  }
  visual.setIntended(revision, triangles);
}

void Workpieces::showTouches(const std::string& id, WorkpieceVisual& visual, ColorBy by) const {
  static const sweep_guard::Touches kNone;
  const auto& objects = touches_ ? touches_->objects : kNone.objects;
  const auto same = [&](const sweep_guard::ObjectTouches& object) { return object.mesh_id == id; };
  const auto object = std::find_if(objects.begin(), objects.end(), same);
  visual.setTouches(object == objects.end() ? sweep_guard::ObjectTouches() : *object, by);
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

std::string Workpieces::legend() const {
  std::string text;
  for (const auto& [id, visual] : visuals_) {
    const std::string legend = visual->legend();
    if (!legend.empty()) text += (text.empty() ? "'" : ", '") + id + "': " + legend;
  }
  return text;
}

std::string Workpieces::problem(const std::string& topic) const {
  if (!problems_.empty()) return "'" + problems_.begin()->first + "': " + problems_.begin()->second;
  if (visuals_.empty()) return "no mesh from " + topic;
  const auto missing = std::find_if(visuals_.begin(), visuals_.end(), [this](auto& one) {
    return !one.second->hasMesh() && cameras_.count(one.first) == 0;
  });
  return missing == visuals_.end() ? "" : "no mesh '" + missing->first + "' from " + topic;
}

}  // namespace sweep_guard_rviz
