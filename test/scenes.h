#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <string>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Random numbers that a seed gives on every machine alike: the standard fixes its engines, not its distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lower, double upper);            ///< in [lower, upper)
  double logUniform(double lower, double upper);         ///< every decade alike; 0 < lower < upper
  int below(int count);                                  ///< 0 to count - 1
  bool chance(double probability);                       ///< true that often
  Eigen::Vector3d inBox(const Eigen::Vector3d& half);    ///< in [-half, half)
  Eigen::Vector3d direction();                           ///< unit
  Eigen::Matrix3d rotation();                            ///< any
  Eigen::Matrix3d turn(double angle);                    ///< by that angle [rad] about any axis
  Eigen::Isometry3d pose(const Eigen::Vector3d& place);  ///< there, turned anyhow

 private:
  std::mt19937_64 engine_;
};

/// A cylinder of about the size `scale` [m]: one in eight flat (length 0), one in eight a needle (radius 0).
ConvexShape randomTool(Random& random, double scale);

/// From a pose near `place` [m]: up to two tool sizes far, turning up to `max_angle` [rad]; one in eight stands still,
/// one in eight only goes, one in eight only turns.
Motion randomMotion(Random& random, const ConvexShape& tool, const Eigen::Vector3d& place, double max_angle);

/// The motion of a hand's millimetres: steps of 1 to 20 mm, turns of 0 to 10 degrees, any direction, at the origin.
Motion handMotion(Random& random);

/// Something to detect.
struct Scene {
  TriangleMesh mesh_M;
  SweptVolume swept_M;
};

/// A swept tool among 20 to 100 triangles of every kind: plain ones, slivers, needles, points, huge ones, ones that lie
/// in a face of the box; 1e-3 to 1e3 m large, up to 1e6 m away, positions in double or in float32.
Scene randomScene(std::uint64_t seed);

/// Up to 20 triangles that touch the volume from outside: a corner of the triangle on a face, an edge on an edge, a
/// face on a corner, box and clipping planes alike; moved out or in by 0, 1, 2, 8 roundings of double or 1e-10 to 1e-2
/// of the volume's size. Of one triangle this is true to the last digits, of the others as far as float32 goes.
Scene grazingScene(std::uint64_t seed);

/// All there is to know of one triangle of a scene, in digits that give back the same numbers.
std::string describe(const Scene& scene, std::uint32_t triangle);

/// The workpiece of the paper's Fig. 7: a closed hull about the origin with a wavy surface, radius about 0.1 m.
/// @param rings, sectors  2 * (rings - 1) * sectors triangles
/// @param phase           of the waves [rad]: deforms it
TriangleMesh wavyHull(int rings, int sectors, double phase);

/// How many scenes to test: the environment variable SWEEP_GUARD_SCENES in percent of the full size, or else
/// `default_percent`.
int sceneCount(int full_size, double default_percent);

}  // namespace sweep_guard_core
