#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Adds triangles by the places of their corners; equal places are one vertex.
class MeshBuilder {
 public:
  void addQuad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
    triangles_.push_back({vertex(a), vertex(b), vertex(c)});
    triangles_.push_back({vertex(a), vertex(c), vertex(d)});
  }
  sweep_guard_core::TriangleMesh finish() const { return {vertices_, triangles_}; }

 private:
  std::uint32_t vertex(const Eigen::Vector3d& p) {
    const std::array<long, 3> key = {std::lround(1e7 * p.x()), std::lround(1e7 * p.y()), std::lround(1e7 * p.z())};
    const auto [found, added] = numbers_.emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (added) vertices_.push_back(p);
    return found->second;
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<sweep_guard_core::Triangle> triangles_;
  std::map<std::array<long, 3>, std::uint32_t> numbers_;
};

/// A square in the plane z = 0 around the origin, of cells x cells squares.
inline sweep_guard_core::TriangleMesh sheetMesh(double side, int cells) {
  MeshBuilder builder;
  const auto at = [&](int i, int j) {
    return Eigen::Vector3d(side * i / cells - side / 2.0, side * j / cells - side / 2.0, 0.0);
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) builder.addQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return builder.finish();
}

/// A cube around the origin, of cells x cells squares on each face.
inline sweep_guard_core::TriangleMesh cubeMesh(double side, int cells) {
  MeshBuilder builder;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {-0.5, 0.5}) {
      const auto at = [&](int i, int j) {
        Eigen::Vector3d p;
        p[axis] = end;
        p[(axis + 1) % 3] = static_cast<double>(i) / cells - 0.5;
        p[(axis + 2) % 3] = static_cast<double>(j) / cells - 0.5;
        return Eigen::Vector3d(side * p);
      };
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          if (end > 0.0) builder.addQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          if (end < 0.0) builder.addQuad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
      }
    }
  }
  return builder.finish();
}

/// The share of a vertex in a face of cubeMesh() across x.
inline double faceShare(const Eigen::RowVector3d& p, double side, int cells) {
  double share = 1.0 / (cells * cells);
  for (const double q : {p.y(), p.z()}) {
    if (std::abs(std::abs(q) - side / 2.0) < 1e-6) share /= 2.0;
  }
  return share;
}

/// A torus around z.
inline sweep_guard_core::TriangleMesh torusMesh(double ring, double tube, int around, int across) {
  MeshBuilder builder;
  const auto at = [&](int i, int j) {
    const double u = 2.0 * M_PI * (i % around) / around;
    const double v = 2.0 * M_PI * (j % across) / across;
    const double r = ring + tube * std::cos(v);
    return Eigen::Vector3d(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) builder.addQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return builder.finish();
}

}  // namespace sweep_guard_simulation
