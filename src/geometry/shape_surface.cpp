#include "geometry/shape_surface.h"

#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr int kSphereRings = 8;
constexpr int kSphereSectors = 16;

}  // namespace

TriangleSurface cylinderSurface(double radius, double length, int sides) {
  const auto n = static_cast<std::uint32_t>(sides);
  const std::uint32_t front_center = 2 * n;
  const std::uint32_t rear_center = 2 * n + 1;
  TriangleSurface surface;
  for (const double z : {0.0, -length}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = kTwoPi * i / n;
      surface.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  surface.vertices.emplace_back(0.0, 0.0, 0.0);
  surface.vertices.emplace_back(0.0, 0.0, -length);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    surface.triangles.push_back({front_center, i, next});
    surface.triangles.push_back({rear_center, n + next, n + i});
    surface.triangles.push_back({i, n + i, next});
    surface.triangles.push_back({next, n + i, n + next});
  }
  return surface;
}

TriangleSurface sphereSurface(double radius) {
  const auto at = [](int ring, int sector) {
    return static_cast<std::uint32_t>(ring * kSphereSectors + sector % kSphereSectors);
  };
  TriangleSurface surface;
  for (int ring = 0; ring <= kSphereRings; ++ring) {
    const double polar = 0.5 * kTwoPi * ring / kSphereRings;
    for (int sector = 0; sector < kSphereSectors; ++sector) {
      const double azimuth = kTwoPi * sector / kSphereSectors;
      const Eigen::Vector3d outwards(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                     std::cos(polar));
      surface.vertices.emplace_back(radius * outwards);
    }
  }
  for (int ring = 0; ring < kSphereRings; ++ring) {
    for (int sector = 0; sector < kSphereSectors; ++sector) {
      surface.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
      surface.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
    }
  }
  return surface;
}

std::array<Eigen::Vector3d, 8> boxCorners(const Eigen::Vector3d& h) {
  std::array<Eigen::Vector3d, 8> corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {(i & 1) != 0 ? h.x() : -h.x(), (i & 2) != 0 ? h.y() : -h.y(), (i & 4) != 0 ? h.z() : -h.z()};
  }
  return corners;
}

TriangleSurface boxSurface(const Eigen::Vector3d& half_extents) {
  const auto corners = boxCorners(half_extents);
  return {{corners.begin(), corners.end()},
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}}};
}

}  // namespace sweep_guard_core
