#include "soundness/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweep_guard_core::soundness {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

PairCase pairOf(const Scene& scene) {
  PairCase pair;
  pair.swept_M = normalized(scene.swept_M);
  for (const Triangle& triangle : scene.mesh_M.triangles()) {
    for (const std::uint32_t vertex : triangle) pair.triangles.corners_M.push_back(scene.mesh_M.vertex(vertex));
  }
  pair.triangles.streamed = scene.mesh_M.origin().isZero(0.0);
  return pair;
}

Motion randomShortMotion(Random& random, const Eigen::Vector3d& place, double size) {
  Motion motion;
  motion.X_MT_start = random.pose(place);
  motion.X_MT_end = motion.X_MT_start;
  const int kind = random.below(4);
  if (kind == 0) return motion;
  if (kind != 1) motion.X_MT_end.translation() += size * random.logUniform(1e-9, 10.0) * random.direction();
  constexpr std::array<double, 4> kAngles = {0.0, 1e-9, 0.175, 1.5};
  const double angle = kAngles[static_cast<size_t>(random.below(4))];
  motion.X_MT_end.linear() = random.turn(angle) * motion.X_MT_start.linear();
  return motion;
}

Eigen::Vector3d anySigns(Random& random, const Eigen::Vector3d& half) {
  Eigen::Vector3d corner = half;
  for (int i = 0; i < 3; ++i) {
    if (random.chance(0.5)) corner[i] = -corner[i];
  }
  return corner;
}

// A point of the surface (on a clip, a face, an edge or a corner of the box) and an outward direction.
struct Spot {
  Eigen::Vector3d p_B;
  Eigen::Vector3d outward;
};

Spot randomSpot(Random& random, const SweptVolume& volume) {
  const Eigen::Vector3d& half = volume.box.half_extents;
  if (!volume.clips_B.empty() && random.chance(0.5)) {
    const HalfSpace& clip = volume.clips_B[static_cast<size_t>(random.below(static_cast<int>(volume.clips_B.size())))];
    const Eigen::Vector3d p = random.inBox(half);
    return {p - clip.signedDistance(p) * clip.normal(), clip.normal()};
  }
  const Eigen::Vector3d corner = anySigns(random, half);
  Spot spot{random.inBox(half), Eigen::Vector3d::Zero()};
  for (int count = 1 + random.below(3); count > 0; --count) {
    const int axis = random.below(3);
    spot.p_B[axis] = corner[axis];
    spot.outward[axis] = std::copysign(random.uniform(0.1, 1.0), corner[axis]);
  }
  spot.outward.normalize();
  return spot;
}

double randomGap(Random& random, double size, double largest) {
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  constexpr std::array<double, 4> kRoundings = {0.0, 1.0, 2.0, 8.0};
  if (random.chance(0.5)) return sign * kRoundings[static_cast<size_t>(random.below(4))] * 0x1p-52 * largest;
  return sign * size * random.logUniform(1e-12, 1e-2);
}

Corners touching(Random& random, const SweptVolume& volume, double size, double largest) {
  const Spot spot = randomSpot(random, volume);
  const Eigen::Vector3d p = spot.p_B + randomGap(random, size, largest) * spot.outward;
  const double room = 0.2 * (kMaxDistance - largest);
  const double side =
      std::min(room, size * (random.chance(0.5) ? random.logUniform(1e-6, 1.0) : random.logUniform(2.0, 1e6)));
  const auto edge = [&] {
    const Eigen::Vector3d along = spot.outward.cross(random.direction()).normalized();
    const double lean = random.chance(0.4) ? 0.0 : random.logUniform(1e-9, 3.0);
    return Eigen::Vector3d(side * (along + lean * spot.outward).normalized());
  };
  switch (random.below(7)) {
    case 0: {  // touches with its interior, or encloses the box
      const Eigen::Vector3d a = edge();
      return {p - a, p + a, p + side * random.direction()};
    }
    case 1: {  // around the spot, in its plane
      const Eigen::Vector3d a = side * spot.outward.cross(random.direction()).normalized();
      const Eigen::Vector3d b = spot.outward.cross(a);
      return {p + a, p - 0.5 * a + b, p - 0.5 * a - b};
    }
    case 2: {  // sliver
      const Eigen::Vector3d a = edge();
      return {p, p + a, p + 0.5 * a + 1e-9 * side * random.direction()};
    }
    case 3: {  // needle
      const Eigen::Vector3d a = edge();
      return {p - 0.5 * a, p + 0.5 * a, p + 0.5 * a};
    }
    case 4:
      return {p, p, p};
    default: {
      const Eigen::Vector3d a = edge();
      return {p, p + a, p + random.uniform(0.01, 1.0) * edge()};
    }
  }
}

}  // namespace

PairCase randomPairs(std::uint64_t seed) { return pairOf(randomScene(seed)); }

PairCase grazingPairs(std::uint64_t seed) { return pairOf(grazingScene(seed)); }

PairCase adversarialPairs(std::uint64_t seed) {
  Random random(seed);
  const double scale = random.logUniform(1e-6, 1e3);
  const Bodies tool = randomBodies(random, scale);
  const double distance = random.chance(0.4) ? 0.0 : std::min(9e6, random.logUniform(1e-3, 1e7));
  const Motion motion = randomShortMotion(random, distance * random.direction(), extentOf(tool));
  const std::vector<VolumeKind> kinds = volumeKinds();
  const VolumeKind kind = kinds[static_cast<size_t>(random.below(static_cast<int>(kinds.size())))];

  PairCase pair;
  pair.swept_M = normalized(sweptVolume(toolOf(tool).whole(), motion, kind, random.chance(0.5) ? 0.0 : 1e-3 * scale));
  const double size = pair.swept_M.box.half_extents.norm();
  const double largest = pair.swept_M.box.X_MB.translation().cwiseAbs().maxCoeff() + size;
  for (int count = 1 + random.below(30); count > 0; --count) {
    for (const Eigen::Vector3d& p_B : touching(random, pair.swept_M, size, largest)) {
      pair.triangles.corners_M.push_back(pair.swept_M.box.X_MB * p_B);
    }
  }
  pair.triangles.streamed = random.chance(0.2);
  return pair;
}

}  // namespace sweep_guard_core::soundness
