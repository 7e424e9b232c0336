#pragma once

#include <sweep_guard/DeformableMesh.h>

#include <functional>

/// Returns the mesh of a square around the origin, of 2 * cells * cells triangles whose normals point up. The caller names it.
/// @param side    [m]
/// @param height  returns z [m] above x and y [m]
inline sweep_guard::DeformableMesh gridMesh(std::uint32_t cells, double side,
                                            const std::function<double(double x, double y)>& height) {
  sweep_guard::DeformableMesh mesh;
  mesh.open = 1;
  for (std::uint32_t row = 0; row <= cells; ++row) {
    for (std::uint32_t column = 0; column <= cells; ++column) {
      geometry_msgs::Point& p = mesh.mesh.vertices.emplace_back();
      p.x = side * column / cells - side / 2.0;
      p.y = side * row / cells - side / 2.0;
      p.z = height(p.x, p.y);
    }
  }
  for (std::uint32_t row = 0; row < cells; ++row) {
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t a = row * (cells + 1) + column;
      mesh.mesh.triangles.emplace_back().vertex_indices = {a, a + 1, a + cells + 1};
      mesh.mesh.triangles.emplace_back().vertex_indices = {a + 1, a + cells + 2, a + cells + 1};
    }
  }
  return mesh;
}
