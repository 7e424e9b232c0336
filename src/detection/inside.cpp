#include "detection/inside.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

namespace sweep_guard_core {
namespace {

// Casts a ray from a point towards +x.
class Ray {
 public:
  Ray(const TriangleMesh& mesh, const Eigen::Vector3d& p) : mesh_(mesh), p_(p - mesh.origin()) {}

  bool crosses(const Triangle& triangle) const {
    const Eigen::Vector3d a = corner(triangle[0]);
    const Eigen::Vector3d b = corner(triangle[1]);
    const Eigen::Vector3d c = corner(triangle[2]);
    if (std::max({a.y(), b.y(), c.y()}) < 0.0 || std::min({a.y(), b.y(), c.y()}) > 0.0) return false;
    if (std::max({a.z(), b.z(), c.z()}) < 0.0 || std::min({a.z(), b.z(), c.z()}) > 0.0) return false;
    const int side = sideOf(triangle[0], triangle[1]);
    if (side != sideOf(triangle[1], triangle[2]) || side != sideOf(triangle[2], triangle[0])) return false;
    return side * a.dot(b.cross(c)) > 0.0;
  }

 private:
  Eigen::Vector3d corner(std::uint32_t vertex) const { return mesh_.offset(vertex) - p_; }

  // Returns on which side of an edge the ray passes, +1 or -1. A ray through the edge counts as shifted by (e, e^2) in
  // y and z, for an infinitesimal e.
  int sideOf(std::uint32_t from, std::uint32_t to) const {
    if (from > to) return -sideOf(to, from);
    const Eigen::Vector3d a = corner(from);
    const Eigen::Vector3d b = corner(to);
    for (const double turn : {a.y() * b.z() - a.z() * b.y(), a.z() - b.z(), b.y() - a.y()}) {
      if (turn != 0.0) return turn > 0.0 ? 1 : -1;
    }
    return 1;
  }

  const TriangleMesh& mesh_;
  Eigen::Vector3d p_;
};

}  // namespace

bool inside(const TriangleMesh& mesh_M, const Eigen::Vector3d& p_M) {
  assert(mesh_M.closed());
  if (!mesh_M.bounds_M().contains(p_M)) return false;
  const Ray ray(mesh_M, p_M);
  const auto& triangles = mesh_M.triangles();
  const auto crossings = std::count_if(triangles.begin(), triangles.end(),
                                       [&](const Triangle& triangle) { return ray.crosses(triangle); });
  return crossings % 2 == 1;
}

}  // namespace sweep_guard_core
