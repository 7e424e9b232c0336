#include "hull.h"

#include <cmath>

#include "common/rotation_between.h"

namespace sweep_guard_benchmark {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kHalfWidth = 0.30;   // [m]
constexpr double kHalfHeight = 0.22;  // [m]
constexpr double kWave = 0.05;        // of the radius
constexpr double kCap = 0.03;         // [rad]
constexpr double kRadius = 0.01;      // of the drill [m]
constexpr double kLength = 0.15;      // of the drill [m]
constexpr double kTilt = kPi / 6.0;   // of the drill [rad]

}  // namespace

Eigen::Vector3d Hull::point(double polar, double azimuth, double phase) const {
  const double wave = 1.0 + kWave * std::sin(5.0 * azimuth + phase) * std::sin(4.0 * polar + 0.7 * phase);
  return wave * Eigen::Vector3d(kHalfWidth * std::sin(polar) * std::cos(azimuth),
                                kHalfWidth * std::sin(polar) * std::sin(azimuth), kHalfHeight * std::cos(polar));
}

Surface Hull::surface(double phase) const {
  const size_t sectors = 2 * rings_;
  Surface surface;
  for (size_t ring = 0; ring <= rings_; ++ring) {
    const double polar = kCap + (kPi - 2.0 * kCap) * static_cast<double>(ring) / static_cast<double>(rings_);
    for (size_t sector = 0; sector < sectors; ++sector) {
      const double azimuth = 2.0 * kPi * static_cast<double>(sector) / static_cast<double>(sectors);
      const Eigen::Vector3f p = point(polar, azimuth, phase).cast<float>();
      surface.positions_M.insert(surface.positions_M.end(), p.data(), p.data() + 3);
    }
  }
  const auto at = [&](size_t ring, size_t sector) {
    return static_cast<std::uint32_t>(ring * sectors + sector % sectors);
  };
  for (size_t ring = 0; ring < rings_; ++ring) {
    for (size_t sector = 0; sector < sectors; ++sector) {
      surface.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
      surface.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
    }
  }
  return surface;
}

sweep_guard_core::Motion Hull::drilling(sweep_guard_core::Random& random, double phase, double depth, double length,
                                        double angle) const {
  const double polar = random.uniform(0.2 * kPi, 0.8 * kPi);
  const double azimuth = random.uniform(0.0, 2.0 * kPi);
  constexpr double kDifference = 1e-6;  // [rad]
  const Eigen::Vector3d p = point(polar, azimuth, phase);
  const Eigen::Vector3d down = point(polar + kDifference, azimuth, phase) - p;
  const Eigen::Vector3d along = point(polar, azimuth + kDifference, phase) - p;
  const Eigen::Vector3d outwards = down.cross(along).normalized();

  const Eigen::Vector3d beside = outwards.cross(random.direction()).normalized();
  const Eigen::Vector3d axis = -(std::cos(kTilt) * outwards + std::sin(kTilt) * beside);
  sweep_guard_core::Motion motion;
  motion.X_MT_start.linear() = sweep_guard_core::rotationBetween(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  motion.X_MT_start.translation() = p - depth * outwards;
  motion.X_MT_end.linear() = random.turn(angle) * motion.X_MT_start.linear();
  motion.X_MT_end.translation() = motion.X_MT_start.translation() + length * random.direction();
  return motion;
}

sweep_guard_core::ConvexShape drill() { return sweep_guard_core::ConvexShape::cylinder(kRadius, kLength); }

Order randomOrder(const Surface& surface) {
  sweep_guard_core::Random random(/*seed=*/surface.triangles.size());
  return {random.permutation(surface.positions_M.size() / 3), random.permutation(surface.triangles.size())};
}

Surface reordered(const Surface& surface, const Order& order) {
  Surface reordered;
  std::vector<std::uint32_t> place(order.vertices.size());
  for (std::uint32_t i = 0; i < order.vertices.size(); ++i) {
    const float* const from = surface.vertex(order.vertices[i]);
    reordered.positions_M.insert(reordered.positions_M.end(), from, from + 3);
    place[order.vertices[i]] = i;
  }
  for (const std::uint32_t from : order.triangles) {
    const auto& [a, b, c] = surface.triangles[from];
    reordered.triangles.push_back({place[a], place[b], place[c]});
  }
  return reordered;
}

}  // namespace sweep_guard_benchmark
