#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/rotation_between.h"
#include "scenes.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Returns a box around the origin; its triangles are counter-clockwise seen from outside, or from inside.
inline TriangleMesh boxMesh(const Eigen::Vector3d& half, bool inside_out = false) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                         (i & 4) != 0 ? half.z() : -half.z());
  }
  std::vector<Triangle> triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (inside_out) {
    for (Triangle& triangle : triangles) std::swap(triangle[0], triangle[1]);
  }
  return TriangleMesh(corners, triangles);
}

/// Returns a square in z = 0 that faces up, of 2 * cells^2 triangles.
inline TriangleMesh sheet(double half_side, std::uint32_t cells) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t j = 0; j <= cells; ++j) {
      vertices.emplace_back(half_side * (2.0 * i / cells - 1.0), half_side * (2.0 * j / cells - 1.0), 0.0);
    }
  }
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t a = i * (cells + 1) + j;
      triangles.push_back({a, a + cells + 1, a + 1});
      triangles.push_back({a + 1, a + cells + 1, a + cells + 2});
    }
  }
  return TriangleMesh(vertices, std::move(triangles));
}

/// A closed mesh with a radius of about 0.1 m and dents.
inline TriangleMesh organ() { return wavyHull(24, 48, 0.3); }

/// Returns a pose with the tip up to 30 mm inside of organ(), the shaft mostly outwards.
inline Eigen::Isometry3d poseInOrgan(Random& random) {
  const Eigen::Vector3d out = random.direction();
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();
  X_MT.linear() =
      random.turn(random.uniform(0.0, 1.0)) * rotationBetween(-Eigen::Vector3d::UnitZ(), out).toRotationMatrix();
  X_MT.translation() = random.uniform(0.07, 0.1) * out;
  return X_MT;
}

}  // namespace sweep_guard_core
