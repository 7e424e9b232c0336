#pragma once

#include <functional>
#include <memory>

#include "detection/culler.h"
#include "detection/gl_select.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Finds triangles by the method of the paper: the swept volume becomes OpenGL's viewing volume, and selection mode
/// names the triangles inside [P, Sec. 3.1]. Triangles that single planes or corners decide are not drawn. The first
/// pass draws the others in blocks that share a name; the second draws the triangles of blocks that hit one by one.
///
/// OpenGL computes in float32. Positions are therefore transformed to box coordinates in double, and the volume is
/// inflated by 2^-22 of the distance to the farthest vertex drawn: six to ten times the largest error found.
class SelectDetector : public Detector {
 public:
  using ContextFactory = std::function<std::unique_ptr<OffscreenContext>()>;

  /// @param options       their gl_context does not count
  /// @param make_context  called again after a failure
  /// @param hit_records   initial size of the selection buffer; it grows
  /// @throws DeviceError if there is no context or it lacks a function
  SelectDetector(const DetectorOptions& options, ContextFactory make_context, size_t hit_records = 256);

 private:
  // Throws DeviceError if the selection fails twice, the second time in a new context.
  void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) override;
  const std::vector<RemainingTriangle>& all(const Submesh& submesh);
  void collectCorners(const TriangleMesh& mesh_M, const OrientedBox& box_M,
                      const std::vector<RemainingTriangle>& remaining);
  double computeInflation(const TriangleMesh& mesh_M, const OrientedBox& box_M) const;
  void select(const SweptVolume& inflated_M);
  void makeSelection();

  const DetectorOptions options_;
  const ContextFactory make_context_;
  const size_t hit_records_;
  std::unique_ptr<GlSelect> gl_;
  Culler culler_;
  std::vector<RemainingTriangle> all_;
  std::vector<Eigen::Vector3d> corners_B_;  // three of each triangle in doubt [m]
  std::vector<float> corners_;              // in units of the box
  std::vector<Eigen::Vector4d> clips_;
  std::vector<std::uint32_t> in_blocks_;  // triangles of the blocks that hit, counted among those in doubt
  std::vector<std::uint32_t> names_;      // triangles that hit, counted among those in doubt
};

}  // namespace sweep_guard_core
