#include "rviz/surface_picker.h"

#include <OgreMath.h>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {

void SurfacePicker::take(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
  surfaces_.erase(mesh->id);
  if (mesh->mesh.triangles.empty() || !indicesInRange(mesh->mesh.triangles, mesh->mesh.vertices.size())) return;
  surfaces_[mesh->id].mesh = mesh;
}

void SurfacePicker::take(const sweep_guard::MeshVertices::ConstPtr& vertices) {
  const auto surface = surfaces_.find(vertices->id);
  if (surface == surfaces_.end() || surface->second.mesh->revision != vertices->revision) return;
  if (vertices->positions.size() == 3 * surface->second.mesh->mesh.vertices.size()) surface->second.vertices = vertices;
}

std::optional<sweep_guard::Intend> SurfacePicker::pick(const Ogre::Ray& ray, const FindFrame& find) const {
  std::optional<sweep_guard::Intend> picked;
  float nearest = 0.0F;
  for (const auto& [id, surface] : surfaces_) {
    const std::string& frame = surface.vertices ? surface.vertices->header.frame_id : surface.mesh->header.frame_id;
    Ogre::Vector3 position;
    Ogre::Quaternion rotation;
    if (!find(frame, position, rotation)) continue;
    const Ogre::Quaternion inverse = rotation.Inverse();
    const Ogre::Ray ray_M(inverse * (ray.getOrigin() - position), inverse * ray.getDirection());
    const auto distance = surface.distance(ray_M);
    if (!distance || (picked && *distance >= nearest)) continue;
    nearest = *distance;
    const Ogre::Vector3 point_M = ray_M.getPoint(nearest);
    picked.emplace();
    picked->mesh_id = id;
    picked->frame_id = frame;
    picked->center.x = static_cast<double>(point_M.x);
    picked->center.y = static_cast<double>(point_M.y);
    picked->center.z = static_cast<double>(point_M.z);
  }
  return picked;
}

Ogre::Vector3 SurfacePicker::PickableSurface::vertex(std::uint32_t index) const {
  if (!vertices) return toOgre(mesh->mesh.vertices[index]);
  const float* const p = &vertices->positions[size_t{3} * index];
  return {p[0], p[1], p[2]};
}

std::optional<float> SurfacePicker::PickableSurface::distance(const Ogre::Ray& ray_M) const {
  std::optional<float> nearest;
  for (const shape_msgs::MeshTriangle& triangle : mesh->mesh.triangles) {
    const auto& corners = triangle.vertex_indices;
    const auto [hit, distance] =
        Ogre::Math::intersects(ray_M, vertex(corners[0]), vertex(corners[1]), vertex(corners[2]));
    if (hit && (!nearest || distance < *nearest)) nearest = distance;
  }
  return nearest;
}

}  // namespace sweep_guard_rviz
