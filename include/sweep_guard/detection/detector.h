#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// Indices of triangles: ascending, each once.
using TriangleSet = std::vector<std::uint32_t>;

/// What Detector::detect() finds.
struct Detection {
  TriangleSet triangles;  ///< triangles that detect() names
  /// Each of them meets the volume grown() by this [m], but in motion; covers the rounding of the detector.
  double inflation = 0.0;
};

/// Finds the triangles of a mesh that a swept volume meets. Made once, queried every cycle. Keeps buffers and devices
/// between queries, but nothing about a mesh: it may deform. Any thread may use a detector, one thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Finds the triangles that the volume meets or touches. Conservative: may also name a triangle that only
  /// swept_M.grown(inflation) meets, and never leaves out one that the volume meets. Takes the vertices as stored: for
  /// the mesh as given, grow the volume by TriangleMesh::rounding().
  /// @param submesh  all of a mesh or some of it; other triangles are not tested. In motion, only for `halfspace`
  /// @param swept_M  in the frame of the mesh
  /// @returns indices into mesh_M().triangles(); valid until the next call
  /// @throws DeviceError if the answer cannot be trusted: then nothing is known. The next call tries again
  const Detection& detect(const Submesh& submesh, const SweptVolume& swept_M) {
    detection_.triangles.clear();
    detection_.inflation = 0.0;
    find(submesh, swept_M, detection_);
    TriangleSet& found = detection_.triangles;
    if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
    if (listener_) listener_(submesh, swept_M, detection_);
    return detection_;
  }

  /// Sets what hears of each answer before detect() returns it; if it throws, detect() does.
  void reportTo(std::function<void(const Submesh&, const SweptVolume&, const Detection&)> listener) {
    listener_ = std::move(listener);
  }

 private:
  // Fills an empty detection. The triangles may be in any order.
  virtual void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) = 0;

  Detection detection_;
  std::function<void(const Submesh&, const SweptVolume&, const Detection&)> listener_;
};

/// `gl_context` that takes the first of offscreenContextNames() that works on this machine.
constexpr const char* kAnyGlContext = "auto";

/// Options of `select`; the other detectors ignore them. They do not change what detect() promises, but without `cull`
/// the inflation may be larger.
struct DetectorOptions {
  bool cull = true;  ///< draw only triangles that tests against the volume's planes leave in doubt
  std::string gl_context = kAnyGlContext;  ///< kAnyGlContext or one of offscreenContextNames()
  int triangles_per_name = 64;             ///< triangles drawn under one OpenGL name in the first pass, >= 1 (asserted)
};

/// Makes a detector.
/// @param name  `select` (OpenGL's selection mode, [P, Sec. 3.1]), `halfspace` (the same test on the processor's vector
///              units) or `reference` (clips every triangle in double precision)
/// @throws InvalidInput if the name of the detector or of the context is unknown, or if the environment variable
///     SWEEP_GUARD_SIMD is wrong (simd::kernels())
/// @throws DeviceError if `select` finds no usable off-screen context: no other detector replaces it, also not on
///     kAnyGlContext (but see availableDetector())
std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options = {});

/// Names a detector for makeDetector().
struct DetectorChoice {
  std::string name;
  DetectorOptions options;
  std::string missing;  ///< the contexts that were tried before and why each failed; empty: none failed

  bool replacesSelect() const { return name == "halfspace" && !missing.empty(); }
};

/// Chooses a detector that this machine can make: `select` on kAnyGlContext becomes `select` on the first context that
/// works or, if none does, `halfspace`. Every other choice stays as it is. Makes a context, to try it: some ms.
DetectorChoice availableDetector(const std::string& name, const DetectorOptions& options = {});

/// Describes a detector for people: its name, and the OpenGL library or the instruction set that it runs on.
std::string describe(const DetectorChoice& detector);

/// Returns the names that makeDetector() knows. The last one, `reference`, shares no code with the others.
const std::vector<std::string>& detectorNames();

/// Returns the names of the off-screen OpenGL contexts that `select` knows, in the order in which kAnyGlContext tries
/// them: `osmesa` and `egl`. They may not be installed.
const std::vector<std::string>& offscreenContextNames();

}  // namespace sweep_guard_core
