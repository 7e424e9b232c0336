#pragma once

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Clips every triangle against every plane in double precision. Slow and simple: what the other detectors are tested
/// against. Its inflation bounds the rounding of double precision alone.
class ReferenceDetector : public Detector {
 private:
  void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) override;
};

}  // namespace sweep_guard_core
