#pragma once

#include <algorithm>
#include <limits>

#include "guard/contact_probability.h"
#include "scenes.h"

namespace sweep_guard_core {

/// Returns whether some of a triangle lies in a volume with its planes moved out by z deviations: clips the triangle.
inline bool meets(const TriangleMesh& mesh_M, const Triangle& triangle, const SweptVolume& swept_M, double z,
                  const PerHalfSpace& deviations) {
  const auto half_spaces_B = swept_M.halfSpaces_B();
  Polygon polygon_B;
  for (const auto vertex : triangle) polygon_B.push_back(swept_M.box.X_MB.inverse() * mesh_M.vertex(vertex));
  for (size_t k = 0; k < half_spaces_B.size(); ++k) {
    polygon_B = clip(polygon_B, half_spaces_B[k].grown(z * deviations[k]));
  }
  return !polygon_B.empty();
}

/// Returns by how many deviations the planes must be moved in until one of them has the triangle wholly beyond it, at the
/// least; as a negative number.
inline double farthestBack(const TriangleMesh& mesh_M, const Triangle& triangle, const SweptVolume& swept_M,
                           const PerHalfSpace& deviations) {
  const auto half_spaces_B = swept_M.halfSpaces_B();
  double back = -std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < half_spaces_B.size(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto vertex : triangle) {
      const double distance = half_spaces_B[k].signedDistance(swept_M.box.X_MB.inverse() * mesh_M.vertex(vertex));
      nearest = std::min(nearest, distance / deviations[k]);
    }
    back = std::max(back, nearest);
  }
  return back;
}

/// Returns the clearance of a volume from a mesh, by clipping every triangle; infinite beyond kMaxDeviations.
inline double clearanceByClipping(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                  const PerHalfSpace& deviations) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh_M.triangles()) {
    if (meets(mesh_M, triangle, swept_M, 0.0, deviations)) {
      least = std::min(least, std::max(-kMaxDeviations, farthestBack(mesh_M, triangle, swept_M, deviations)));
    }
    double lower = 0.0;
    double upper = std::min(least, kMaxDeviations);
    if (upper <= 0.0 || !meets(mesh_M, triangle, swept_M, upper, deviations)) continue;
    while (upper - lower > 1e-4) {
      const double middle = 0.5 * (lower + upper);
      (meets(mesh_M, triangle, swept_M, middle, deviations) ? upper : lower) = middle;
    }
    least = std::min(least, upper);
  }
  return least;
}

}  // namespace sweep_guard_core
