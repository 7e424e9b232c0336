#include "detection/halfspace_detector.h"

#include "detection/box_coordinates.h"
#include "detection/convex_clip.h"
#include "detection/float_planes.h"

namespace sweep_guard_core {

void HalfspaceDetector::find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) {
  const TriangleMesh& mesh_M = submesh.mesh_M();
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  detection.inflation = 2.0 * coordinates.rounding();  // the rounding of clipping can add triangles beyond the rounding
  const std::vector<RemainingTriangle>& candidates = culler_.cull(submesh, floatPlanes(mesh_M, swept_M));
  if (candidates.empty()) return;
  const ConvexClip clip(swept_M.grown(coordinates.rounding()));
  const auto meets = [&](const Triangle& triangle) {
    return clip.meets(
        {coordinates.position(triangle[0]), coordinates.position(triangle[1]), coordinates.position(triangle[2])});
  };
  for (const RemainingTriangle& candidate : candidates) {
    if (candidate.met || submesh.isInMotion() || meets(mesh_M.triangles()[candidate.triangle]))
      detection.triangles.push_back(candidate.triangle);
  }
}

}  // namespace sweep_guard_core
