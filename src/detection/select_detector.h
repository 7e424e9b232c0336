#pragma once

#include <functional>
#include <memory>

#include "detection/gl_select.h"
#include "sweep_guard/detection/culler.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// The method of the paper: the swept volume becomes OpenGL's viewing volume, and selection mode names the triangles
/// inside [P, Sec. 3.1]. What single planes or corners decide is not drawn. Of the others, blocks of triangles share a
/// name at first; single triangles are drawn only inside the blocks that hit.
///
/// OpenGL computes in float32. So positions are taken into the box's own coordinates in double, and the volume is
/// inflated by 2^-22 of the distance to the farthest vertex drawn: six to ten times the worst error found.
class SelectDetector : public Detector {
 public:
  using ContextFactory = std::function<std::unique_ptr<OffscreenContext>()>;
  struct Options {
    bool cull = true;          ///< draw only what is in doubt; otherwise everything
    int block = 64;            ///< triangles under one name in the first pass; >= 1
    size_t hit_records = 256;  ///< room in the selection buffer at first; it grows
  };

  /// @throws DeviceError if there is no context or it lacks a function
  explicit SelectDetector(const Options& options, ContextFactory make_context = makeOsMesaContext);

 private:
  // Throws DeviceError if the selection fails twice, the second time in a new context.
  void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) override;
  const std::vector<RemainingTriangle>& all(const Submesh& part);
  void takeCorners(const TriangleMesh& mesh_M, const OrientedBox& box_M,
                   const std::vector<RemainingTriangle>& remaining);
  double inflationFor(const TriangleMesh& mesh_M, const OrientedBox& box_M) const;
  void select(const SweptVolume& inflated_M);
  void makeSelection();

  Options options_;
  ContextFactory make_context_;
  std::unique_ptr<GlSelect> gl_;
  Culler culler_;
  std::vector<RemainingTriangle> all_;
  std::vector<Eigen::Vector3d> corners_B_;  // three of each triangle in doubt [m]
  std::vector<float> corners_;              // in units of the box
  std::vector<Eigen::Vector4d> clips_;
  std::vector<std::uint32_t> in_blocks_;  // numbers among those in doubt
  std::vector<std::uint32_t> names_;      // those of them that hit
};

}  // namespace sweep_guard_core
