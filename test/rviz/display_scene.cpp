#include "display_scene.h"

#include <array>

#include "grid_mesh.h"

namespace sweep_guard_rviz {

using sweep_guard::DeformableMesh;
using sweep_guard::MeshVertices;
using sweep_guard::View;

namespace {

std::vector<std::uint32_t> range(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = begin; i < end; ++i) all.push_back(i);
  return all;
}

}  // namespace

DeformableMesh square(double z, std::uint32_t revision) {
  DeformableMesh mesh = gridMesh(kSide, 4.0, [z](double /*x*/, double /*y*/) { return z; });
  mesh.header.frame_id = "world";
  mesh.id = "square";
  mesh.revision = revision;
  return mesh;
}

MeshVertices verticesOf(const DeformableMesh& mesh) {
  MeshVertices vertices;
  vertices.header = mesh.header;
  vertices.id = mesh.id;
  vertices.revision = mesh.revision;
  for (const geometry_msgs::Point& p : mesh.mesh.vertices) {
    for (const double value : {p.x, p.y, p.z}) vertices.positions.push_back(static_cast<float>(value));
  }
  return vertices;
}

View viewOf(std::uint8_t level) {
  View view;
  view.header.frame_id = "world";
  view.level = level;
  view.pose.orientation.w = 1.0;
  view.pose.position.z = 1.0;
  sweep_guard::ObjectView& object = view.objects.emplace_back();
  object.mesh_id = "square";
  object.revision = 1;
  object.frame_id = "world";
  object.touched = range(80, 95);
  object.reflex = range(90, 110);
  object.considered = range(100, 140);
  return view;
}

sweep_guard::ToolShape tetrahedron() {
  sweep_guard::ToolShape shape;
  shape_msgs::Mesh& part = shape.parts.emplace_back();
  part.vertices.resize(4);
  part.vertices[0].z = part.vertices[1].x = part.vertices[2].y = 0.5;
  for (const auto& corners : {std::array{0U, 1U, 2U}, {0U, 1U, 3U}, {0U, 2U, 3U}, {1U, 2U, 3U}}) {
    part.triangles.emplace_back().vertex_indices = {corners[0], corners[1], corners[2]};
  }
  return shape;
}

}  // namespace sweep_guard_rviz
