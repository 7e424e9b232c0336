#include "sweep_guard/guard/path_test.h"

#include <algorithm>
#include <iterator>

namespace sweep_guard {
namespace {

Matrix6d turned(const Matrix6d& covariance_W, const Eigen::Matrix3d& R_MW) {
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = R_MW;
  R.bottomRightCorner<3, 3>() = R_MW;
  return R * covariance_W * R.transpose();
}

using Triangles = std::vector<std::uint32_t>;

void unite(Triangles& all, const Triangles& more) {
  Triangles both;
  std::set_union(all.begin(), all.end(), more.begin(), more.end(), std::back_inserter(both));
  all.swap(both);
}

Triangles without(const Triangles& all, const Triangles& others) {
  Triangles rest;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

struct PathTest::Piece {
  Duration from;
  Duration to;
  Motion motion_M;

  std::pair<Piece, Piece> halves() const {
    const Duration middle = from + (to - from) / 2;
    const Eigen::Isometry3d X_MT = motion_M.at(0.5);
    return {{from, middle, {motion_M.X_MT_start, X_MT}}, {middle, to, {X_MT, motion_M.X_MT_end}}};
  }
};

struct PathTest::Query {
  Detector& detector;
  const Tool& tool;
  const TriangleMesh& mesh_M;
  Matrix6d covariance_M;  // at the end of the sweep
  bool met_before;        // by a sweep before this one
  PredictedSweep sweep;
  Triangles triangles;
  std::vector<SweptVolume> volumes_M;
};

PredictedObject PathTest::operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                                     const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                                     std::shared_ptr<const Workpiece> workpiece) {
  const Eigen::Isometry3d X_MW = X_WM.inverse();
  PredictedObject object{workpiece, {}, {}, {}, {}};
  object.sweeps.reserve(path.size());
  Duration from = Duration::zero();
  Eigen::Isometry3d X_MT = X_MW * X_WT;
  bool met = false;
  for (const ExpectedPose& pose : path) {
    const Eigen::Isometry3d X_MT_end = X_MW * pose.X_WT;
    Query query{detector, tool, workpiece->mesh_M, turned(pose.covariance, X_MW.linear()), met, {from}, {}, {}};
    test(query, {from, pose.ahead, {X_MT, X_MT_end}});
    met = met || query.sweep.met;
    unite(object.sweeps.size() < reflex_sweeps ? object.reflex : object.considered, query.triangles);
    object.sweeps.push_back(query.sweep);
    std::move(query.volumes_M.begin(), query.volumes_M.end(), std::back_inserter(object.volumes_M));
    from = pose.ahead;
    X_MT = X_MT_end;
  }
  object.considered = without(object.considered, object.reflex);
  return object;
}

void PathTest::test(Query& query, const Piece& piece) {
  const bool whole = query.volumes_M.empty();
  Triangles met;
  double probability = 0.0;
  for (const Motion& part : split(piece.motion_M, options_.sweep.max_rotation)) {
    SweptVolume volume_M =
        sweptVolume(query.tool, part, options_.sweep.volume, options_.sweep.margin + query.mesh_M.rounding());
    const auto sigmas = planeDeviations(query.tool, part.X_MT_end, query.covariance_M, volume_M);
    if (const auto clearance = measure_(query.mesh_M, volume_M, sigmas)) {
      probability = std::max(probability, contactProbability(clearance->deviations));
      if (!clearance->separated) unite(met, query.detector.detect(query.mesh_M, volume_M).triangles);
    }
    if (whole) query.volumes_M.push_back(std::move(volume_M));
  }

  if (!met.empty() && !query.met_before && !query.sweep.met && piece.to - piece.from > options_.finest) {
    const auto [first, second] = piece.halves();
    test(query, first);
    test(query, second);
    return;
  }
  query.sweep.probability = std::max(query.sweep.probability, probability);
  if (met.empty()) return;
  if (!query.sweep.met) query.sweep.contact_from = piece.from;
  query.sweep.met = true;
  unite(query.triangles, met);
}

}  // namespace sweep_guard
