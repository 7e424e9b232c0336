#pragma once

#include "sweep_guard/detection/culler.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Decides on the processor's vector units what is certain in float32, and clips what is left in double. Names what the
/// reference names, but for the rounding of double precision.
class HalfspaceDetector : public Detector {
 public:
  /// @param kernels  what they are makes no difference but in time
  explicit HalfspaceDetector(const simd::Kernels& kernels = simd::kernels()) : culler_(kernels) {}

 private:
  void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) override;

  Culler culler_;
};

}  // namespace sweep_guard_core
