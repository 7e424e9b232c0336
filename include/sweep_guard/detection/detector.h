#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// What a detector found.
struct Detection {
  std::vector<std::uint32_t>
      triangles;           ///< indices of the triangles met: ascending, each once; empty: the way is clear
  double inflation = 0.0;  ///< what is named is nearer to the volume than this [m]: the price of rounding
};

/// Finds the triangles of a mesh that a swept volume meets. Made once, queried every cycle; holds buffers and devices,
/// nothing about a deformation. One thread at a time; any thread.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Conservative: may name a triangle that is closer to the volume than `inflation`, never leaves out one that meets
  /// it. Touching is meeting.
  /// @param part  of a mesh, or all of one: no other triangles are looked at
  /// @returns valid until the next call
  /// @throws DeviceError if the answer cannot be trusted: nothing is known then
  const Detection& detect(const Submesh& part, const SweptVolume& swept_M) {
    detection_.triangles.clear();
    detection_.inflation = 0.0;
    find(part, swept_M, detection_);
    return detection_;
  }

 protected:
  Detector() = default;
  Detector(const Detector&) = default;
  Detector& operator=(const Detector&) = default;

 private:
  // Fills an empty detection.
  virtual void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) = 0;

  Detection detection_;
};

/// What `select` is made with. No other detector looks at it, and the answer does not depend on it but for a smaller
/// inflation with `cull`.
struct DetectorOptions {
  bool cull = true;                   ///< show OpenGL only the triangles in doubt after a test against single planes
  std::string gl_context = "osmesa";  ///< one of offscreenContextNames()
};

/// @param name  `select` (OpenGL's selection mode, [P, Sec. 3.1]), `halfspace` (the same test on the processor's vector
///              units) or `reference` (every triangle clipped in double precision)
/// @throws InvalidInput on any other name of a detector or context, DeviceError if there is no off-screen context
std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options = {});

/// The names that makeDetector() knows.
const std::vector<std::string>& detectorNames();

}  // namespace sweep_guard_core
