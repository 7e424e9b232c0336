#include "sweep_guard/detection/reference_detector.h"

#include "sweep_guard/detection/box_coordinates.h"

namespace sweep_guard {
namespace {

bool meets(Polygon polygon, const std::vector<HalfSpace>& half_spaces) {
  for (const HalfSpace& half_space : half_spaces) {
    polygon = clip(polygon, half_space);
    if (polygon.empty()) return false;
  }
  return true;
}

}  // namespace

Detection ReferenceDetector::find(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                  const std::vector<std::uint32_t>* candidates) {
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  Detection detection;
  detection.inflation = 2.0 * coordinates.rounding();  // clipping itself can let in what is a little farther out, too
  const std::vector<HalfSpace> half_spaces = swept_M.grown(coordinates.rounding()).halfSpaces_B();
  const std::vector<Triangle>& triangles = mesh_M.triangles();
  const auto look = [&](std::uint32_t i) {
    const auto& [a, b, c] = triangles[i];
    if (meets({coordinates(a), coordinates(b), coordinates(c)}, half_spaces)) detection.triangles.push_back(i);
  };
  if (candidates != nullptr) {
    for (const std::uint32_t i : *candidates) look(i);
  } else {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) look(i);
  }
  return detection;
}

}  // namespace sweep_guard
