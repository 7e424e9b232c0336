#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard {

struct SweepOptions {
  VolumeKind volume = VolumeKind::kObbPlanes;
  double max_rotation = 0.175;  ///< a motion that turns more is split [rad], in (0, 1.5]
  double margin = 0.0;          ///< the tool is grown by this [m], >= 0
};

/// What the tool meets of one mesh while it moves.
struct SweepFindings {
  std::vector<std::uint32_t> triangles;  ///< ascending, each once
  double margin = 0.0;                   ///< largest growth of a volume tested, for arcs, rounding and as asked for [m]
  /// Those tested, end to end, in the mesh's frame: of the tool's parts, and where a box around several meets nothing,
  /// of that.
  std::vector<SweptVolume> volumes_M;
};

/// Tests the volumes that the tool sweeps in each part of its motion: down the tree of its boxes, as far as they meet
/// something, to its convex parts. What is found is what these meet.
/// @param parts  of split(): each turns by little, so that the margin for its arc stays small
/// @throws DeviceError if the detector fails
SweepFindings testSweep(Detector& detector, const Tool& tool, const std::vector<Motion>& parts,
                        const TriangleMesh& mesh_M, const SweepOptions& options);

/// Takes in what was found in a later part of the same motion.
void unite(SweepFindings& all, SweepFindings more);

/// What the tool meets along a path of poses.
struct PathFindings {
  std::vector<std::uint32_t> triangles;  ///< union over the path: ascending, each once
  double margin = 0.0;                   ///< largest over the path [m]
  std::optional<size_t> first_met;       ///< first sweep that met something; sweep i goes from pose i to pose i + 1
};

/// Tests every sweep of a path; a path of one pose is tested where it stands.
/// @param path     at least one X_MT
/// @param between  called before every sweep; may throw to give up
/// @throws DeviceError if the detector fails
PathFindings testPath(
    Detector& detector, const Tool& tool, const std::vector<Eigen::Isometry3d>& path, const TriangleMesh& mesh_M,
    const SweepOptions& options, const std::function<void()>& between = [] {});

}  // namespace sweep_guard
