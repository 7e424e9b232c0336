#include "sweep_guard/guard/sweep_test.h"

#include <algorithm>
#include <cassert>

#include "sweep_guard/detection/float_planes.h"
#include "sweep_guard/detection/inside.h"
#include "sweep_guard/guard/swept_body.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

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
  unite(all, later, ascending);  // of both, that of before is kept
}

}  // namespace

// Down the tool's tree: whatever a box does not meet, the bodies in it do not meet either. Its planes are enough to see
// that; the detector, which is dear for what it names, is asked about the parts.
struct SweepTest::TreeWalk {
  Detector& detector;
  const Tool& tool;
  const MovingMesh& mesh;
  const SweepOptions& options;
  Motion motion_M;
  SweepTest& test;

  void visit(size_t index, const MeshPart& around, size_t depth) {
    const Tool::Node& node = tool.tree()[index];
    const SweptBody body = sweptBody(node.shape_T, motion_M, options.volume, options.margin + mesh.spread());
    SweepFindings& findings = test.findings_;
    double inflation = 0.0;
    if (node.part) {
      detect(detector, around, body, test.detection_);
      inflation = test.detection_.inflation;
      unite(test.met_by_[*node.part], test.detection_.triangles);
      unite(findings.triangles, test.detection_.triangles);
    } else if (visitBelow(node, body.volume_M, around, depth)) {
      return;
    }
    findings.margin = std::max(findings.margin, body.volume_M.margin + inflation);
    findings.volumes_M.push_back(body.volume_M);
  }

  bool visitBelow(const Tool::Node& node, const SweptVolume& volume_M, const MeshPart& around, size_t depth) {
    const simd::Planes planes = floatPlanes(mesh.mesh_M(), volume_M);
    while (test.finders_.size() <= depth) test.finders_.emplace_back();
    const MeshPart near = test.finders_[depth](around, planes);
    if (test.cull_(near, planes).empty()) return false;
    for (const size_t below : node.below) visit(below, near, depth + 1);
    return true;
  }
};

void SweepFindings::clear() {
  triangles.clear();
  margin = 0.0;
  volumes_M.clear();
  fine = false;
  met.clear();
  touched.clear();
  inside = false;
}

void unite(SweepFindings& all, const SweepFindings& more) {
  unite(all.triangles, more.triangles);
  all.margin = std::max(all.margin, more.margin);
  all.volumes_M.insert(all.volumes_M.end(), more.volumes_M.begin(), more.volumes_M.end());
  all.fine = more.fine;
  unite(all.met, more.met);
  join(all.touched, more.touched);
  all.inside = all.inside || more.inside;
}

SweepFindings& SweepTest::operator()(Detector& detector, const Tool& tool, const std::vector<Motion>& parts,
                                     const MovingMesh& mesh, const SweepOptions& options, const SweptBefore& before) {
  findings_.clear();
  met_by_.resize(tool.parts().size());
  for (TriangleSet& met : met_by_) met.clear();
  for (Motion motion_M : parts) {
    motion_M.drift = mesh.drift_M();
    TreeWalk{detector, tool, mesh, options, motion_M, *this}.visit(0, mesh.mesh_M(), 0);
  }
  findings_.fine = options.fine;
  findings_.met = findings_.triangles;
  if (options.fine) confirmMet(tool, parts, mesh, options.margin, before);
  if (findings_.met.empty() && !before.outside) {
    findings_.inside = anyPartInside(tool, parts.back().X_MT_end, mesh.mesh_M());
  }
  return findings_;
}

// What is settled counts as met by the volume alone.
void SweepTest::confirmMet(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh, double margin,
                           const SweptBefore& before) {
  for (TriangleSet& met : met_by_) remove(met, before.settled);
  confirm(tool, parts, mesh, met_by_, margin, before.ways_in, confirmation_);
  keepOnly(findings_.met, before.settled);
  unite(findings_.met, confirmation_.met);
  findings_.touched = confirmation_.touched;
}

SweepFindings testSweep(Detector& detector, const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
                        const SweepOptions& options, const SweptBefore& before) {
  return SweepTest()(detector, tool, parts, mesh, options, before);
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
    unite(along.all, sweep);
  }
  return along;
}

SweptBefore known(const SweepFindings& findings) {
  SweptBefore known{{}, !findings.contact(), {}};
  for (const TouchedTriangle& one : findings.touched)
    known.ways_in.emplace_hint(known.ways_in.end(), one.triangle, one.impact.normal_M);
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
