#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard {

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
  /// @throws DeviceError if the answer cannot be trusted: nothing is known then
  Detection detect(const TriangleMesh& mesh_M, const SweptVolume& swept_M) { return find(mesh_M, swept_M, nullptr); }

  /// The same, of these triangles alone.
  /// @param candidates  indices of triangles: ascending, each once
  Detection detectAmong(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                        const std::vector<std::uint32_t>& candidates) {
    return find(mesh_M, swept_M, &candidates);
  }

 protected:
  Detector() = default;
  Detector(const Detector&) = default;
  Detector& operator=(const Detector&) = default;

 private:
  // Among all triangles if there are no candidates.
  virtual Detection find(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                         const std::vector<std::uint32_t>* candidates) = 0;
};

/// What `select` is made with. No other detector looks at it, and the answer does not depend on it but for a smaller
/// inflation with `cull`.
struct DetectorOptions {
  bool cull = true;                   ///< show OpenGL only the triangles that are not beyond one plane
  std::string gl_context = "osmesa";  ///< one of offscreenContextNames()
};

/// @param name  `select` (OpenGL's selection mode, [P, Sec. 3.1]) or `reference` (every triangle clipped in double
/// precision)
/// @throws InvalidInput on any other name of a detector or context, DeviceError if there is no off-screen context
std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options = {});

/// The names that makeDetector() knows.
const std::vector<std::string>& detectorNames();

}  // namespace sweep_guard
