#include "detection/reference_detector.h"

#include "common/heartbeat.h"
#include "detection/box_coordinates.h"

namespace sweep_guard_core {
namespace {

bool meets(Polygon polygon, const std::vector<HalfSpace>& half_spaces) {
  for (const HalfSpace& half_space : half_spaces) {
    polygon = clip(polygon, half_space);
    if (polygon.empty()) return false;
  }
  return true;
}

}  // namespace

void ReferenceDetector::find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) {
  const TriangleMesh& mesh_M = submesh.mesh_M();
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  detection.inflation = 2.0 * coordinates.rounding();  // the rounding of clipping can add triangles beyond the rounding
  const std::vector<HalfSpace> half_spaces = swept_M.grown(coordinates.rounding()).halfSpaces_B();
  submesh.forEachTriangle([&](std::uint32_t i) {
    beat();
    const auto& [a, b, c] = mesh_M.triangles()[i];
    if (meets({coordinates.position(a), coordinates.position(b), coordinates.position(c)}, half_spaces))
      detection.triangles.push_back(i);
  });
}

}  // namespace sweep_guard_core
