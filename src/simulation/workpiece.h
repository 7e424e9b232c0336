#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// A workpiece of the demo: a triangle mesh that deforms as a function of time, its triangles staying the same. Every
/// vertex runs on a small ellipse around where it rests, so it has moved in every frame. Coordinates are in the frame M
/// of the workpiece, whose origin is the centre of its bounding box at rest.
class Workpiece {
 public:
  struct Options {
    double size = 0.6;        ///< [m] in [0.001, 100]; largest extent at rest
    double amplitude = 0.01;  ///< [-] in [0, 0.05]; no vertex moves farther from its rest than this part of the size
    double period = 2.0;      ///< [s] in [0.01, 1000]; of one deformation
  };

  /// A closed, wavy ellipsoid (0.6 x 0.6 x 0.44 m at the default size) with waves moving over it along x.
  /// @param triangles  in [6, 1000000]; the count made is the nearest of the form 2 * sectors * rings with cells of
  ///     usable shape: 400 and 1600 exactly, others within 1 %
  /// @throws sweep_guard_core::InvalidInput if a number is out of range
  static Workpiece hull(int triangles, const Options& options);

  /// The triangles of a file that readMesh() reads, scaled to the size and swaying: it bends and shears as a whole.
  /// @throws sweep_guard_core::InvalidInput if a number is out of range, the file is refused, or its points are all in one
  ///     place
  static Workpiece fromFile(const std::string& path, const Options& options);

  /// x0 y0 z0 x1 ... in M [m] at time `t` [s], one triple per vertex.
  std::vector<float> positions(double t) const;
  const std::vector<sweep_guard_core::Triangle>& triangles() const { return triangles_; }
  std::size_t vertexCount() const { return vertices_.size(); }

 private:
  /// Displacement of a vertex: amplitude * (cos(phase) * along + sin(phase) * across), `along` of length 1 and `across`
  /// of length 1 at most, at right angles to it.
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
