#pragma once

#include "guard_probe.h"

namespace sweep_guard_ros {

/// Returns a closed cube with its center at a point [m].
inline sweep_guard::DeformableMesh cubeAt(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                          double half_side) {
  sweep_guard::DeformableMesh cube = squareAt(id, center, stamp);
  cube.open = 0;
  cube.mesh.vertices.clear();
  cube.mesh.triangles.clear();
  for (int corner = 0; corner < 8; ++corner) {
    geometry_msgs::Point& p = cube.mesh.vertices.emplace_back();
    p.x = center.x() + ((corner & 4) != 0 ? half_side : -half_side);
    p.y = center.y() + ((corner & 2) != 0 ? half_side : -half_side);
    p.z = center.z() + ((corner & 1) != 0 ? half_side : -half_side);
  }
  constexpr std::uint32_t kTriangles[][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                                             {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  for (const auto& [a, b, c] : kTriangles) cube.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  return cube;
}

/// Returns the same with three vertices for each triangle.
inline sweep_guard::DeformableMesh separated(sweep_guard::DeformableMesh mesh) {
  std::vector<geometry_msgs::Point> vertices;
  for (shape_msgs::MeshTriangle& triangle : mesh.mesh.triangles) {
    for (std::uint32_t& corner : triangle.vertex_indices) {
      vertices.push_back(mesh.mesh.vertices[corner]);
      corner = static_cast<std::uint32_t>(vertices.size()) - 1;
    }
  }
  mesh.mesh.vertices = vertices;
  return mesh;
}

/// Returns the vertices of a mesh, each moved.
template <typename Move>
sweep_guard::MeshVertices verticesOf(const sweep_guard::DeformableMesh& mesh, ros::Time stamp, const Move& move) {
  sweep_guard::MeshVertices vertices;
  vertices.header = mesh.header;
  vertices.header.stamp = stamp;
  vertices.id = mesh.id;
  vertices.revision = mesh.revision;
  for (const geometry_msgs::Point& p : mesh.mesh.vertices) {
    const Eigen::Vector3d moved = move(Eigen::Vector3d(p.x, p.y, p.z));
    for (int i = 0; i < 3; ++i) vertices.positions.push_back(static_cast<float>(moved[i]));
  }
  return vertices;
}

}  // namespace sweep_guard_ros
