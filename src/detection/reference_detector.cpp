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

Detection ReferenceDetector::detect(const TriangleMesh& mesh_M, const SweptVolume& swept_M) {
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  Detection detection;
  detection.inflation = coordinates.rounding();
  const std::vector<HalfSpace> half_spaces = swept_M.grown(detection.inflation).halfSpaces_B();
  const std::vector<Triangle>& triangles = mesh_M.triangles();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    if (meets({coordinates(a), coordinates(b), coordinates(c)}, half_spaces)) detection.triangles.push_back(i);
  }
  return detection;
}

}  // namespace sweep_guard
