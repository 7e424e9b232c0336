#include "sweep_guard/guard/sweep_test.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "sweep_guard/detection/cull.h"
#include "sweep_guard/guard/swept_body.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

// Down the tool's tree: whatever a box does not meet, the bodies in it do not meet either. Its planes are enough to see
// that; the detector, which is dear for what it names, is asked about the parts, and where a box is far from all.
struct TreeWalk {
  Detector& detector;
  const Tool& tool;
  const TriangleMesh& mesh_M;
  const SweepOptions& options;
  const Motion& motion_M;
  SweepFindings& findings;
  Cull cull = {};

  void visit(size_t index, const TriangleSet* among) {
    const Tool::Node& node = tool.tree()[index];
    SweptBody body = sweptBody(node.shape_T, motion_M, options.volume, options.margin + mesh_M.rounding());
    TriangleSet near;
    if (!node.part) {
      near = among == nullptr ? cull(mesh_M, body.volume_M) : cull(mesh_M, body.volume_M, *among);
      if (!near.empty()) {
        for (const size_t below : node.below) visit(below, &near);
        return;
      }
      among = &near;
    }
    const Detection detection = detect(detector, mesh_M, body, among);
    findings.margin = std::max(findings.margin, body.volume_M.margin + detection.inflation);
    findings.triangles = united(findings.triangles, detection.triangles);
    findings.volumes_M.push_back(std::move(body.volume_M));
  }
};

}  // namespace

void unite(SweepFindings& all, SweepFindings more) {
  all.triangles = united(all.triangles, more.triangles);
  all.margin = std::max(all.margin, more.margin);
  std::move(more.volumes_M.begin(), more.volumes_M.end(), std::back_inserter(all.volumes_M));
}

SweepFindings testSweep(Detector& detector, const Tool& tool, const std::vector<Motion>& parts,
                        const TriangleMesh& mesh_M, const SweepOptions& options) {
  SweepFindings findings;
  for (const Motion& part : parts) TreeWalk{detector, tool, mesh_M, options, part, findings}.visit(0, nullptr);
  return findings;
}

PathFindings testPath(Detector& detector, const Tool& tool, const std::vector<Eigen::Isometry3d>& path,
                      const TriangleMesh& mesh_M, const SweepOptions& options, const std::function<void()>& between) {
  assert(!path.empty());
  PathFindings along;
  for (size_t i = 0; i < std::max<size_t>(path.size() - 1, 1); ++i) {
    between();
    const Motion motion{path[i], path[std::min(i + 1, path.size() - 1)]};
    const SweepFindings sweep = testSweep(detector, tool, split(motion, options.max_rotation), mesh_M, options);
    if (!sweep.triangles.empty() && !along.first_met) along.first_met = i;
    along.triangles = united(along.triangles, sweep.triangles);
    along.margin = std::max(along.margin, sweep.margin);
  }
  return along;
}

}  // namespace sweep_guard
