#include "guard/contact_probability.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/heartbeat.h"
#include "detection/box_coordinates.h"
#include "detection/convex_clip.h"
#include "detection/float_planes.h"

namespace sweep_guard_core {
namespace {

constexpr double kMinDeviation = 1e-9;      // [m]; smaller deviations are rounded up
constexpr double kTolerance = 1e-3;         // [standard deviations]
constexpr double kClippingRounding = 1e-6;  // [standard deviations], of clipping

double deviationAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& r, const Matrix6d& covariance) {
  Eigen::Matrix<double, 6, 1> J;
  J << n, r.cross(n);
  return std::sqrt(std::max(0.0, J.dot(covariance * J)));
}

// Returns the standard deviation of the tool's support along a unit direction. The other end of the tool is behind by
// `gap`; within kMaxDeviations of its own deviation it may become the support.
double supportDeviation(const ConvexShape& shape, const Eigen::Matrix3d& R_MT, const Eigen::Vector3d& n_M,
                        const Matrix6d& covariance_M) {
  const Eigen::Vector3d n_T = R_MT.transpose() * n_M;
  const Eigen::Vector3d front_T = shape.frontSupport(n_T);
  const Eigen::Vector3d rear_T = shape.rearSupport(n_T);
  const double front = deviationAlong(n_M, R_MT * front_T, covariance_M);
  const double rear = deviationAlong(n_M, R_MT * rear_T, covariance_M);
  const double ahead = n_T.dot(front_T - rear_T);
  const double gap = std::abs(ahead);
  const auto& [touching, other] = ahead < 0.0 ? std::pair(rear, front) : std::pair(front, rear);
  return std::max(touching, other - gap / kMaxDeviations);
}

bool isIntended(IntendedTriangles* intended, std::uint32_t triangle, const TriangleMesh& mesh_M) {
  return intended != nullptr && intended->contains(triangle, mesh_M);
}

}  // namespace

double contactProbability(double deviations) {
  return deviations > kMaxDeviations ? 0.0 : 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

PerHalfSpace planeDeviations(const ConvexShape& shape, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                             const SweptVolume& swept_M) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  PerHalfSpace sigmas;
  swept_M.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double /*offset*/) {
    const Eigen::Vector3d n_M = R_MB * normal_B;
    sigmas.push_back(std::max(kMinDeviation, supportDeviation(shape, X_MT.linear(), n_M, covariance_M)));
  });
  return sigmas;
}

// The planes of a volume, relative to the origin of the mesh and in standard deviations: a point is N p - d of them out.
struct ClearanceMeter::Planes {
  using Scores = Eigen::Array<double, kMaxHalfSpaces, 1>;

  Planes(const TriangleMesh& mesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas) : mesh_M(mesh) {
    const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
    const Eigen::Vector3d center = swept_M.box.X_MB.translation() - mesh.origin();
    const double margin = 2.0 * BoxCoordinates(mesh, swept_M.box).rounding();
    swept_M.grown(margin).forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
      const Eigen::Vector3d normal_M = R_MB * normal_B;
      const double sigma = sigmas[count];
      normals.row(static_cast<Eigen::Index>(count)) = normal_M.array() / sigma;
      offsets[static_cast<Eigen::Index>(count++)] = (normal_M.dot(center) + offset) / sigma;
    });
    assert(count == sigmas.size());
  }

  Corners corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_M.triangles()[triangle];
    return {mesh_M.offset(a), mesh_M.offset(b), mesh_M.offset(c)};
  }
  Scores scores(const Eigen::Vector3d& p) const {
    return normals.col(0) * p.x() + normals.col(1) * p.y() + normals.col(2) * p.z() - offsets;
  }
  NearTriangle candidate(std::uint32_t triangle) const {
    const auto& [p, q, r] = corners(triangle);
    const Scores a = scores(p);
    const Scores b = scores(q);
    const Scores c = scores(r);
    return {triangle, a.min(b).min(c).maxCoeff(), std::min({a.maxCoeff(), b.maxCoeff(), c.maxCoeff()})};
  }

  const TriangleMesh& mesh_M;
  size_t count = 0;
  Eigen::Array<double, kMaxHalfSpaces, 3> normals = Eigen::Array<double, kMaxHalfSpaces, 3>::Zero();
  Scores offsets = Scores::Constant(std::numeric_limits<double>::max());  // of what is no plane: nothing is beyond it
};

ClearanceMeter::ClearanceMeter(double max_deviations, const simd::Kernels& kernels)
    : max_deviations_(max_deviations), kernels_(&kernels), culler_(kernels) {}

// Moves the planes out as far as the nearest vertex: the fewer triangles are within, the fewer have to be compared. That
// vertex may belong to no triangle of the submesh: if there is nothing within, moves them out all the way.
std::optional<Clearance> ClearanceMeter::measure(const Submesh& submesh, const SweptVolume& swept_M,
                                                 const PerHalfSpace& sigmas, IntendedTriangles* intended,
                                                 double at_most) {
  beat();
  candidates_.clear();
  if (submesh.empty()) return {};
  at_most = std::min(at_most, max_deviations_);
  const double reach = reachOfVertices(submesh, swept_M, sigmas, at_most, kTolerance);
  const Planes planes(submesh.mesh_M(), swept_M, sigmas);
  const auto nearestUpTo = [&](double limit) {
    collectCandidates(within(limit, submesh, swept_M, sigmas), limit, planes, intended);
    return nearestWithin(limit, planes);
  };
  auto clearance = nearestUpTo(reach);
  if (!clearance && reach < at_most) clearance = nearestUpTo(at_most);
  const bool separated = candidates_.empty() || candidates_.front().at_least > 0.0;
  if (!clearance && !separated && at_most < max_deviations_) {
    double enclosing = max_deviations_;
    for (const NearTriangle& candidate : candidates_) enclosing = std::min(enclosing, candidate.at_most);
    clearance = nearestUpTo(std::max(enclosing, at_most));
  }
  return clearance;
}

bool ClearanceMeter::isNear(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas,
                            IntendedTriangles* intended) {
  beat();
  if (submesh.empty()) return false;
  const double reach = reachOfVertices(submesh, swept_M, sigmas, max_deviations_, kTolerance);
  const Planes planes(submesh.mesh_M(), swept_M, sigmas);
  const auto isWithin = [&](double limit) {
    const auto& remaining = within(limit, submesh, swept_M, sigmas);
    const auto any = [&](const auto& test) {
      return std::any_of(remaining.begin(), remaining.end(), [&](const RemainingTriangle& triangle) {
        return test(triangle) && !isIntended(intended, triangle.triangle, submesh.mesh_M());
      });
    };
    return any([](const RemainingTriangle& triangle) { return triangle.met; }) ||
           any([&](const RemainingTriangle& triangle) {
             return reaches(limit, planes.corners(triangle.triangle), planes);
           });
  };
  return isWithin(reach) || (reach < max_deviations_ && isWithin(max_deviations_));
}

bool ClearanceMeter::mayBeNear(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas) {
  if (submesh.empty()) return false;
  const bool vertex = reachOfVertices(submesh, swept_M, sigmas, max_deviations_, max_deviations_) < max_deviations_;
  return vertex || isNear(submesh, swept_M, sigmas);
}

bool ClearanceMeter::isSeparated(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas,
                                 double by) {
  beat();
  PerHalfSpace outwards = sigmas;
  for (double& distance : outwards) distance *= by;
  return !culler_.leavesAny(submesh, floatPlanes(submesh.mesh_M(), swept_M, outwards));
}

// Returns by how many deviations the planes must be moved out, from 0 to `at_most`, to enclose a vertex of the submesh's
// blocks: the nearest one, or one that is nearer than `enough`.
double ClearanceMeter::reachOfVertices(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas,
                                       double at_most, double enough) {
  const simd::Planes planes = floatPlanes(submesh.mesh_M(), swept_M);
  simd::PerPlane inverse{};
  std::transform(sigmas.begin(), sigmas.end(), inverse.begin(), [](double sigma) { return float(1.0 / sigma); });
  const size_t count = submesh.blocks().size();
  scores_.resize(std::max(scores_.size(), simd::padded(count)));
  kernels_->scoreBoxes(submesh.boxes(), count, planes, inverse, scores_.data());
  double nearest = at_most;
  const auto lookAt = [&](size_t block) {
    withBlock(submesh.mesh_M().places(), submesh.blocks()[block], [&](const float* vertices) {
      nearest = std::min(nearest, kernels_->scoreBlock(vertices, planes, inverse) + kTolerance);
    });
  };
  near_blocks_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (scores_[i] < nearest) near_blocks_.push_back(i);
  }
  const auto first = std::min_element(near_blocks_.begin(), near_blocks_.end(),
                                      [&](std::uint32_t a, std::uint32_t b) { return scores_[a] < scores_[b]; });
  if (first != near_blocks_.end()) lookAt(*first);
  for (auto block = near_blocks_.begin(); block != near_blocks_.end() && nearest >= enough; ++block) {
    if (block != first && scores_[*block] + kTolerance < nearest) lookAt(*block);
  }
  return std::clamp(nearest, 0.0, at_most);
}

// Returns the triangles that no plane, moved out by so many deviations, separates from the volume.
const std::vector<RemainingTriangle>& ClearanceMeter::within(double reach, const Submesh& submesh,
                                                             const SweptVolume& swept_M, PerHalfSpace sigmas) {
  for (double& sigma : sigmas) sigma *= reach;
  return culler_.cull(submesh, floatPlanes(submesh.mesh_M(), swept_M, sigmas));
}

std::optional<Clearance> ClearanceMeter::nearestWithin(double reach, const Planes& planes) const {
  const bool separated = candidates_.empty() || candidates_.front().at_least > 0.0;
  double nearest = reach + kTolerance;
  for (const NearTriangle& candidate : candidates_) {
    beat();
    if (candidate.at_least > nearest - kTolerance) break;
    const auto corners = planes.corners(candidate.triangle);
    if (candidate.at_least <= 0.0 && reaches(kClippingRounding, corners, planes)) {
      return Clearance{separated, std::max(candidate.at_least, -kMaxDeviations)};
    }
    nearest = std::min(nearest, deviationsTo(nearest, candidate, planes));
  }
  if (nearest > reach) return {};
  return Clearance{separated, nearest};
}

const std::vector<std::uint32_t>& ClearanceMeter::notSeparated(const Submesh& submesh, const SweptVolume& swept_M) {
  beat();
  not_separated_.clear();
  if (submesh.empty()) return not_separated_;
  const PerHalfSpace unit(6 + swept_M.clips_B.size(), 1.0);
  const Planes planes(submesh.mesh_M(), swept_M, unit);
  for (const RemainingTriangle& remaining : within(0.0, submesh, swept_M, unit)) {
    const bool not_separated = remaining.met || planes.candidate(remaining.triangle).at_least <= 0.0;
    if (not_separated) not_separated_.push_back(remaining.triangle);
  }
  return not_separated_;
}

// Bisects. Returns `nearest` if the candidate is not nearer.
double ClearanceMeter::deviationsTo(double nearest, const NearTriangle& candidate, const Planes& planes) {
  const auto corners = planes.corners(candidate.triangle);
  double lower = std::max(candidate.at_least, 0.0);
  double upper = std::min(nearest - kTolerance, candidate.at_most);
  if (lower > upper || (upper < candidate.at_most && !reaches(upper, corners, planes))) return nearest;
  if (reaches(lower + kClippingRounding, corners, planes)) return lower;
  while (upper - lower > kTolerance) {
    const double middle = 0.5 * (lower + upper);
    (reaches(middle, corners, planes) ? upper : lower) = middle;
  }
  return upper;
}

// Returns whether the planes, moved out by z, enclose some of the triangle. Skips planes that enclose it wholly.
bool ClearanceMeter::reaches(double z, const Corners& corners, const Planes& planes) {
  const auto& [a, b, c] = corners;
  const Planes::Scores highest = planes.scores(a).max(planes.scores(b)).max(planes.scores(c));
  ClippedTriangle remaining(corners);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(planes.count) && !remaining.empty(); ++i) {
    if (highest[i] > z) remaining.cut(planes.normals.row(i).matrix(), planes.offsets[i] + z);
  }
  return !remaining.empty();
}

// Collects the triangles that may need the fewest deviations, in this order. At the limit, a corner of one is enclosed.
void ClearanceMeter::collectCandidates(const std::vector<RemainingTriangle>& remaining, double reach,
                                       const Planes& planes, IntendedTriangles* intended) {
  double limit = reach + kTolerance;
  candidates_.clear();
  for (const RemainingTriangle& triangle : remaining) {
    const NearTriangle candidate = planes.candidate(triangle.triangle);
    if (candidate.at_least > limit || isIntended(intended, triangle.triangle, planes.mesh_M)) continue;
    candidates_.push_back(candidate);
    limit = std::min(limit, candidate.at_most);
  }
  const auto too_far = [&](const NearTriangle& candidate) { return candidate.at_least > limit; };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), too_far), candidates_.end());
  std::sort(candidates_.begin(), candidates_.end(),
            [](const NearTriangle& x, const NearTriangle& y) { return x.at_least < y.at_least; });
}

}  // namespace sweep_guard_core
