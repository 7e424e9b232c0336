#include "motion/facing.h"

#include <algorithm>
#include <limits>

#include "common/heartbeat.h"
#include "geometry/penetration.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

PieceCover::Corners Facing::corners(std::uint32_t triangle) const {
  PieceCover::Corners corners = cover.corners(mesh().triangles()[triangle]);
  const double depth = allowedDepth(triangle);
  if (depth == 0.0) return corners;
  const Eigen::Vector3d inwards = (corners[2] - corners[0]).cross(corners[1] - corners[0]).stableNormalized();
  for (Eigen::Vector3d& corner : corners) corner += depth * inwards;
  return corners;
}

std::uint32_t Facing::triangleAt(const Cluster& cluster, std::uint64_t bits) const {
  const auto& triangle_at = mesh().order().triangle_at;
  const std::uint32_t place = cluster.first + static_cast<std::uint32_t>(__builtin_ctzll(bits));
  return triangle_at.empty() ? place : triangle_at[place];
}

SeparatedTriangle Facing::separate(std::uint32_t triangle) {
  beat();
  const ConvexShape& shape_T = cover.shape_T();
  const PieceCover::Corners corners_T = cover.corners_T(corners(triangle));
  const PointHull hull(corners_T);
  const Separation apart = separation(shape_T, hull, /*accuracy=*/0.0, guess_T);
  guess_T = apart.gap > 0.0 ? apart.normal : contactNormal_T(triangle, corners_T);
  const Eigen::Vector3d top_T = hull.supportPoint(guess_T);
  return {triangle, guess_T, -shape_T.support(-guess_T) - guess_T.dot(top_T), top_T};
}

Eigen::Vector3d Facing::contactNormal_T(std::uint32_t triangle, const PieceCover::Corners& corners_T) const {
  if (const auto* contacts = surface->contacts) {
    const auto before = [](const TriangleContact& contact, std::uint32_t index) { return contact.triangle < index; };
    const auto contact = std::lower_bound(contacts->begin(), contacts->end(), triangle, before);
    if (contact != contacts->end() && contact->triangle == triangle) return cover.normal_T(contact->impact.normal_M);
  }
  const PointHull hull(corners_T);
  const auto& [a, b, c] = corners_T;
  Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
  if (!(normal.norm() > 0.5)) normal = cover.shape_T().proposeNormal(corners_T);
  const double depth = depthAlong(normal, cover.shape_T(), hull);
  return depth <= depthAlong(-normal, cover.shape_T(), hull) ? normal : Eigen::Vector3d(-normal);
}

void Facing::forgetNearest() {
  nearest = std::numeric_limits<double>::infinity();
  cover.setNearest(std::nullopt);
}

}  // namespace sweep_guard_core
