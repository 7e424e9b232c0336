#include "sweep_guard/detection/halfspace_detector.h"

#include "sweep_guard/detection/box_coordinates.h"
#include "sweep_guard/detection/convex_clip.h"
#include "sweep_guard/detection/float_planes.h"

namespace sweep_guard {

void HalfspaceDetector::find(const MeshPart& part, const SweptVolume& swept_M, Detection& detection) {
  const TriangleMesh& mesh_M = part.mesh_M();
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  detection.inflation = 2.0 * coordinates.rounding();  // clipping itself can let in what is a little farther out, too
  const ConvexClip clip(swept_M.grown(coordinates.rounding()));
  const auto meets = [&](const Triangle& triangle) {
    return clip.meets({coordinates(triangle[0]), coordinates(triangle[1]), coordinates(triangle[2])});
  };
  for (const Survivor& survivor : cull_(part, floatPlanes(mesh_M, swept_M))) {
    if (survivor.met || meets(mesh_M.triangles()[survivor.triangle])) detection.triangles.push_back(survivor.triangle);
  }
}

}  // namespace sweep_guard
