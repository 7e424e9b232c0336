#include "sweep_guard/guard/sweep_test.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "sweep_guard/detection/cull.h"
#include "sweep_guard/detection/float_planes.h"
#include "sweep_guard/detection/inside.h"
#include "sweep_guard/guard/swept_body.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

// Down the tool's tree: whatever a box does not meet, the bodies in it do not meet either. Its planes are enough to see
// that; the detector, which is dear for what it names, is asked about the parts.
struct TreeWalk {
  Detector& detector;
  const Tool& tool;
  const MovingMesh& mesh;
  const SweepOptions& options;
  Motion motion_M;
  SweepFindings& findings;
  std::vector<TriangleSet>& met_by;  // each part of the tool
  Cull cull = {};
  Detection detection = {};

  void visit(size_t index, const MeshPart& around) {
    const Tool::Node& node = tool.tree()[index];
    SweptBody body = sweptBody(node.shape_T, motion_M, options.volume, options.margin + mesh.spread());
    detection = {};
    if (node.part) {
      detect(detector, around, body, detection);
      met_by[*node.part] = united(met_by[*node.part], detection.triangles);
      findings.triangles = united(findings.triangles, detection.triangles);
    } else if (visitBelow(node, body.volume_M, around)) {
      return;
    }
    findings.margin = std::max(findings.margin, body.volume_M.margin + detection.inflation);
    findings.volumes_M.push_back(std::move(body.volume_M));
  }

  bool visitBelow(const Tool::Node& node, const SweptVolume& volume_M, const MeshPart& around) {
    const simd::Planes planes = floatPlanes(mesh.mesh_M(), volume_M);
    PartFinder finder;
    const MeshPart near = finder(around, planes);
    if (cull(near, planes).empty()) return false;
    for (const size_t below : node.below) visit(below, near);
    return true;
  }
};

bool anyPartInside(const Tool& tool, const Eigen::Isometry3d& X_MT, const TriangleMesh& mesh_M) {
  return mesh_M.closed() && std::any_of(tool.parts().begin(), tool.parts().end(), [&](const ToolPart& part) {
           return inside(mesh_M, X_MT * part.shape_T.moments_T().mean);
         });
}

bool ascending(const TouchedTriangle& a, const TouchedTriangle& b) { return a.triangle < b.triangle; }

// When and where is told of the first touch; how deep, and along which normal, of the last.
void join(std::vector<TouchedTriangle>& all, const std::vector<TouchedTriangle>& later) {
  for (TouchedTriangle& one : all) {
    const auto again = std::lower_bound(later.begin(), later.end(), one, ascending);
    const bool touches = again != later.end() && again->triangle == one.triangle;
    if (touches) one.impact.normal_M = again->impact.normal_M;
    one.impact.depth = touches ? again->impact.depth : 0.0;
  }
  std::vector<TouchedTriangle> both;
  std::set_union(all.begin(), all.end(), later.begin(), later.end(), std::back_inserter(both), ascending);
  all = std::move(both);
}

}  // namespace

void unite(SweepFindings& all, SweepFindings more) {
  all.triangles = united(all.triangles, more.triangles);
  all.margin = std::max(all.margin, more.margin);
  std::move(more.volumes_M.begin(), more.volumes_M.end(), std::back_inserter(all.volumes_M));
  all.fine = more.fine;
  all.met = united(all.met, more.met);
  join(all.touched, more.touched);
  all.inside = all.inside || more.inside;
}

SweepFindings testSweep(Detector& detector, const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
                        const SweepOptions& options, const SweptBefore& before) {
  SweepFindings findings;
  std::vector<TriangleSet> met_by(tool.parts().size());
  for (Motion motion_M : parts) {
    motion_M.drift = mesh.drift_M();
    TreeWalk{detector, tool, mesh, options, motion_M, findings, met_by}.visit(0, mesh.mesh_M());
  }
  findings.fine = options.fine;
  if (options.fine) {
    for (TriangleSet& met : met_by) met = without(met, before.settled);
    Confirmation confirmed = confirm(tool, parts, mesh, met_by, options.margin, before.ways_in);
    findings.met = united(confirmed.met, without(findings.triangles, without(findings.triangles, before.settled)));
    findings.touched = std::move(confirmed.touched);
  } else {
    findings.met = findings.triangles;
  }
  if (findings.met.empty() && !before.outside) {
    findings.inside = anyPartInside(tool, parts.back().X_MT_end, mesh.mesh_M());
  }
  return findings;
}

PathFindings testPath(Detector& detector, const Tool& tool, const std::vector<Eigen::Isometry3d>& path,
                      const TriangleMesh& mesh_M, const SweepOptions& options, const std::function<void()>& between) {
  assert(!path.empty());
  PathFindings along;
  SweptBefore before;
  for (size_t i = 0; i < std::max<size_t>(path.size() - 1, 1); ++i) {
    between();
    const Motion motion{path[i], path[std::min(i + 1, path.size() - 1)]};
    SweepFindings sweep = testSweep(detector, tool, split(motion, options.max_rotation), mesh_M, options, before);
    if (sweep.contact() && !along.first_met) {
      along.first_met = i;
      along.time_of_impact = firstTime(sweep);
    }
    before = known(sweep);
    unite(along.all, std::move(sweep));
  }
  return along;
}

SweptBefore known(const SweepFindings& findings) {
  SweptBefore known{{}, !findings.contact(), {}};
  for (const TouchedTriangle& one : findings.touched) known.ways_in.emplace_hint(known.ways_in.end(), one.triangle, one.impact.normal_M);
  return known;
}

std::optional<double> firstTime(const SweepFindings& findings) {
  if (!findings.fine) return std::nullopt;
  if (findings.inside) return 0.0;
  std::optional<double> first;
  for (const TouchedTriangle& one : findings.touched) {
    first = std::min(first.value_or(1.0), one.impact.time_of_impact);
  }
  return first;
}

}  // namespace sweep_guard
