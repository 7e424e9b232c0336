#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Random numbers that depend on the seed alone, on every machine: the standard specifies engines, not distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lower, double upper);            ///< in [lower, upper)
  double logUniform(double lower, double upper);         ///< uniform in the logarithm; 0 < lower < upper
  int below(int count);                                  ///< 0 to count - 1
  bool chance(double probability);                       ///< true with this probability
  Eigen::Vector3d inBox(const Eigen::Vector3d& half);    ///< in [-half, half)
  Eigen::Vector3d direction();                           ///< unit
  Eigen::Matrix3d rotation();                            ///< random
  Eigen::Matrix3d turn(double angle);                    ///< by this angle [rad] about a random axis
  Eigen::Isometry3d pose(const Eigen::Vector3d& place);  ///< at `place` [m], with a random rotation
  std::vector<std::uint32_t> permutation(size_t count);  ///< of 0 to count - 1

 private:
  std::mt19937_64 engine_;
};

/// Returns a cylinder of about the size `scale` [m]. One in eight is flat (length 0), one in eight a needle (radius 0).
ConvexShape randomTool(Random& random, double scale);

/// Returns a cylinder, a sphere, a box or a hull of so many points: 5 to 200 mm.
ConvexShape randomShape(Random& random, int hull_points);

/// Returns a motion that begins at `place` [m], moves by up to two tool sizes and turns by up to `max_angle` [rad]. One
/// in eight rests, one in eight only translates, one in eight only turns.
Motion randomMotion(Random& random, const ConvexShape& tool, const Eigen::Vector3d& place, double max_angle);

/// Returns a motion like that of a hand, at the origin: 1 to 20 mm and 0 to 10 degrees in random directions.
Motion handMotion(Random& random);

/// Returns the mesh after a deformation.
inline TriangleMesh deformed(TriangleMesh mesh, std::vector<float> positions_M) {
  mesh.deform(positions_M);
  return mesh;
}

/// Returns a pose at a place [m] that is not turned.
inline Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) {
  return Eigen::Isometry3d(Eigen::Translation3d(place));
}
inline Eigen::Isometry3d placedAt(double x, double y, double z) { return placedAt({x, y, z}); }
inline Eigen::Isometry3d along(double x) { return placedAt(x, 0.0, 0.0); }
inline Eigen::Isometry3d up(double z) { return placedAt(0.0, 0.0, z); }

/// A mesh and a volume to test against it.
struct Scene {
  TriangleMesh mesh_M;
  SweptVolume swept_M;
};

/// Returns a swept tool among 20 to 100 triangles: regular and huge triangles, slivers, needles, points, triangles in a
/// face of the box. Sizes are 1e-3 to 1e3 m, distances from the origin up to 1e6 m, positions double or float32.
Scene randomScene(std::uint64_t seed);

/// Returns up to 20 triangles that touch the volume from outside: a corner on a face, an edge on an edge or a face on a
/// corner, of the box or of its clips. They are moved out or in by 0, 1, 2 or 8 roundings of double, or by 1e-10 to
/// 1e-2 of the volume's size. One triangle is exact to the last digits, the others to float32.
Scene grazingScene(std::uint64_t seed);

/// Describes one triangle and the volume of a scene, with all digits.
std::string describe(const Scene& scene, std::uint32_t triangle);

/// Returns the workpiece of [P, Fig. 7]: a closed hull around the origin with a wavy surface, radius about 0.1 m.
/// @param rings, sectors  2 * (rings - 1) * sectors triangles
/// @param phase           of the waves [rad]: deforms it
TriangleMesh wavyHull(int rings, int sectors, double phase);

/// Returns the surface of a square around the origin, of 2 * cells * cells triangles whose normals point up.
/// @param side    [m]
/// @param height  returns z [m] above x and y [m]; called once for each vertex, row by row
TriangleMesh gridSurface(std::uint32_t cells, double side, const std::function<double(double x, double y)>& height);

/// Returns the vertices in float32 as a MeshVertices message has them: x0 y0 z0 x1 ... [m]
std::vector<float> streamedPositions(const TriangleMesh& mesh);

/// Returns how many scenes to test: a percentage of `full_size`, from the environment variable SWEEP_GUARD_SCENES or
/// `default_percent`.
int sceneCount(int full_size, double default_percent);

}  // namespace sweep_guard_core
