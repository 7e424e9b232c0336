#pragma once

#include "sweep_guard/detection/detector.h"

namespace sweep_guard {

/// Clips every triangle against every plane in double precision. Slow and simple: what the other detectors are tested
/// against. Its inflation bounds the rounding of double precision alone.
class ReferenceDetector : public Detector {
 private:
  Detection find(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                 const std::vector<std::uint32_t>* candidates) override;
};

}  // namespace sweep_guard
