#pragma once

#include "detection/culler.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Decides on the processor's vector units what is certain in float32, and clips the other triangles in double. Finds
/// the same triangles as the reference, up to the rounding of double precision. Of a mesh in motion, names each triangle that
/// does not lie wholly beyond one plane of the volume at both ends of its way.
class HalfspaceDetector : public Detector {
 public:
  /// @param kernels  change the run time only
  explicit HalfspaceDetector(const simd::Kernels& kernels = simd::kernels()) : culler_(kernels) {}

 private:
  void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) override;

  Culler culler_;
};

}  // namespace sweep_guard_core
