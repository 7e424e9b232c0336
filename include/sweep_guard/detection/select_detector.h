#pragma once

#include <functional>
#include <memory>

#include "sweep_guard/detection/cull.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/gl_select.h"

namespace sweep_guard {

/// The method of the paper: the swept volume becomes OpenGL's viewing volume, and selection mode names the triangles
/// inside [P, Sec. 3.1]. Blocks of triangles share a name at first; single triangles are drawn only inside the blocks
/// that hit.
///
/// OpenGL computes in float32. So positions are taken into the box's own coordinates in double, and the volume is
/// inflated by 2^-22 of the distance to the farthest vertex drawn: six to ten times the worst error found.
class SelectDetector : public Detector {
 public:
  using ContextFactory = std::function<std::unique_ptr<OffscreenContext>()>;
  struct Options {
    bool cull = true;          ///< draw only what is not beyond one plane of the volume
    int block = 64;            ///< triangles under one name in the first pass; >= 1
    size_t hit_records = 256;  ///< room in the selection buffer at first; it grows
  };

  /// @throws DeviceError if there is no context or it lacks a function
  explicit SelectDetector(const Options& options, ContextFactory make_context = makeOsMesaContext);

 private:
  // Throws DeviceError if the selection fails twice, the second time in a new context.
  Detection find(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                 const std::vector<std::uint32_t>* among) override;
  std::vector<std::uint32_t> select(const TriangleMesh& mesh_M, const SweptVolume& inflated_M,
                                    const std::vector<std::uint32_t>& candidates);
  void makeSelection();
  const std::vector<std::uint32_t>& candidatesOf(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                                 const std::vector<std::uint32_t>* among);
  const std::vector<std::uint32_t>& allTriangles(const TriangleMesh& mesh_M);

  Options options_;
  ContextFactory make_context_;
  std::unique_ptr<GlSelect> gl_;
  Cull cull_;
  std::vector<std::uint32_t> all_;
  std::vector<float> corners_;
};

}  // namespace sweep_guard
