#pragma once

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Clips every triangle against every plane in double precision. Slow and simple; the other detectors are tested
/// against it. Its inflation bounds the rounding of double precision only.
class ReferenceDetector : public Detector {
 private:
  void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) override;
};

}  // namespace sweep_guard_core
