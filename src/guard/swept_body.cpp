#include "sweep_guard/guard/swept_body.h"

namespace sweep_guard {

SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin) {
  return {&shape_T, motion_M, sweptVolume(shape_T, motion_M, kind, margin)};
}

Detection detect(Detector& detector, const TriangleMesh& mesh_M, const SweptBody& body, const TriangleSet* among) {
  return among == nullptr ? detector.detect(mesh_M, body.volume_M)
                          : detector.detectAmong(mesh_M, body.volume_M, *among);
}

}  // namespace sweep_guard
