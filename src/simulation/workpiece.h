#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Deforming workpiece of the demo: a triangle mesh whose vertices are functions of time. Every vertex moves on a small
/// ellipse around its rest position, so every vertex moves in every frame. Coordinates are in the frame M of the
/// workpiece, whose origin is the center of the bounding box at rest.
class Workpiece {
 public:
  struct Options {
    double size = 0.6;        ///< [m] in [0.001, 100]; largest extent at rest
    double amplitude = 0.01;  ///< [-] in [0, 0.05]; largest distance from rest, relative to the size
    double period = 2.0;      ///< [s] in [0.01, 1000]; of one deformation
  };

  /// Constructs a closed, wavy ellipsoid (0.6 x 0.6 x 0.44 m at the default size) with waves that move along x.
  /// @param triangles  in [6, 1000000]; rounded to the form 2 * sectors * rings with well-shaped cells: 400 and 1600
  ///     are exact, others are within 1 %
  /// @throws sweep_guard_core::InvalidInput if a number is out of range
  static Workpiece hull(int triangles, const Options& options);

  /// Constructs a workpiece from a file that readMesh() reads, scaled to the size. It bends and shears as a whole.
  /// @throws sweep_guard_core::InvalidInput if a number is out of range, the file is refused, or all points are equal
  static Workpiece fromFile(const std::string& path, const Options& options);

  /// Returns x0 y0 z0 x1 ... in M [m] at time `t` [s].
  std::vector<float> positions(double t) const;
  const std::vector<sweep_guard_core::Triangle>& triangles() const { return triangles_; }
  std::size_t vertexCount() const { return vertices_.size(); }

 private:
  /// The displacement is amplitude * (cos(phase) * along + sin(phase) * across). `along` has length 1; `across` has a
  /// length of at most 1 and is orthogonal to `along`.
  struct Vertex {
    Eigen::Vector3d rest;    // [m]
    Eigen::Vector3d along;   // [-]
    Eigen::Vector3d across;  // [-]
    double phase;            // [rad]
  };

  Workpiece(const std::vector<Eigen::Vector3d>& points, std::vector<sweep_guard_core::Triangle> triangles,
            const Options& options);
  void makeWaves(const Options& options);
  void makeSway(const Options& options);

  std::vector<sweep_guard_core::Triangle> triangles_;
  std::vector<Vertex> vertices_;
  double amplitude_;     // [m]
  double angular_rate_;  // [rad/s]
};

}  // namespace sweep_guard_simulation
