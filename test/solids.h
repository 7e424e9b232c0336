#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// A surface as a sender may give it.
struct SentSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  TriangleMesh mesh(bool is_sheet = false) const { return {vertices, triangles, is_sheet}; }

  SentSurface& add(const SentSurface& other) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles) triangles.push_back({first + a, first + b, first + c});
    return *this;
  }
  SentSurface moved(const Eigen::Affine3d& X) const {
    SentSurface surface = *this;
    for (Eigen::Vector3d& vertex : surface.vertices) vertex = X * vertex;
    return surface;
  }
  SentSurface movedBy(double x, double y, double z) const {
    return moved(Eigen::Affine3d(Eigen::Translation3d(x, y, z)));
  }
  SentSurface reversed() const {
    SentSurface surface = *this;
    for (Triangle& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
    return surface;
  }
  /// Returns the same with three vertices for each triangle.
  SentSurface separate() const {
    SentSurface surface;
    for (const Triangle& triangle : triangles) {
      const auto first = static_cast<std::uint32_t>(surface.vertices.size());
      for (const std::uint32_t corner : triangle) surface.vertices.push_back(vertices[corner]);
      surface.triangles.push_back({first, first + 1, first + 2});
    }
    return surface;
  }
  SentSurface without(size_t triangle) const {
    SentSurface surface = *this;
    surface.triangles.erase(surface.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
    return surface;
  }
};

/// Returns the surface of a cube around the origin, counter-clockwise seen from outside, with 2 * cells^2 triangles on each
/// face.
inline SentSurface cubeSurface(double half, std::uint32_t cells = 1) {
  SentSurface surface;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? -1.0 : 1.0;
    for (std::uint32_t i = 0; i <= cells; ++i) {
      for (std::uint32_t k = 0; k <= cells; ++k) {
        Eigen::Vector3d p;
        p[axis] = side * half;
        p[(axis + 1) % 3] = half * (2.0 * i / cells - 1.0);
        p[(axis + 2) % 3] = side * half * (2.0 * k / cells - 1.0);
        surface.vertices.push_back(p);
      }
    }
    const auto first = static_cast<std::uint32_t>(surface.vertices.size()) - (cells + 1) * (cells + 1);
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (std::uint32_t k = 0; k < cells; ++k) {
        const std::uint32_t a = first + i * (cells + 1) + k;
        const std::uint32_t b = a + cells + 1;
        surface.triangles.push_back({a, b, b + 1});
        surface.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return surface;
}

/// Returns a square of 2 * cells^2 triangles around the origin that is parallel to x and y.
inline SentSurface plate(double half, std::uint32_t cells = 1) {
  SentSurface surface = cubeSurface(half, cells);
  const size_t count = size_t{cells + 1} * (cells + 1);
  surface.vertices.erase(surface.vertices.begin(), surface.vertices.end() - static_cast<std::ptrdiff_t>(count));
  surface.triangles.resize(size_t{2} * cells * cells);
  for (Eigen::Vector3d& vertex : surface.vertices) vertex.z() = 0.0;
  return surface;
}

}  // namespace sweep_guard_core
