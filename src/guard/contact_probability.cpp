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

constexpr double kMinDeviation = 1e-9;  // [m]; smaller deviations are rounded up
constexpr double kTolerance = 1e-3;     // [standard deviations]
constexpr double kRounding = 1e-6;      // [standard deviations], of clipping

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

struct ClearanceMeter::Planes {
  struct Plane {
    Eigen::Vector3d normal;
    double offset;
  };

  const TriangleMesh& mesh_M;
  BoxCoordinates coordinates;
  boost::container::static_vector<Plane, kMaxHalfSpaces> planes_B;
  const PerHalfSpace& sigmas;

  size_t count() const { return sigmas.size(); }
  std::array<Eigen::Vector3d, 3> corners_B(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_M.triangles()[triangle];
    return {coordinates.position(a), coordinates.position(b), coordinates.position(c)};
  }
};

ClearanceMeter::Planes ClearanceMeter::findCandidates(const Submesh& submesh, const SweptVolume& swept_M,
                                                      const PerHalfSpace& sigmas) {
  beat();
  const BoxCoordinates coordinates(submesh.mesh_M(), swept_M.box);
  Planes planes{submesh.mesh_M(), coordinates, {}, sigmas};
  swept_M.grown(2.0 * coordinates.rounding()).forEachHalfSpace([&](const Eigen::Vector3d& normal, double offset) {
    planes.planes_B.push_back({normal, offset});
  });
  assert(planes.planes_B.size() == planes.count());
  PerHalfSpace farthest = sigmas;
  for (double& sigma : farthest) sigma *= kMaxDeviations;
  remaining_ = &culler_.cull(submesh, floatPlanes(submesh.mesh_M(), swept_M, farthest));
  scoreCorners(planes);
  collectCandidates(planes);
  return planes;
}

std::optional<Clearance> ClearanceMeter::measure(const Submesh& submesh, const SweptVolume& swept_M,
                                                 const PerHalfSpace& sigmas) {
  const Planes planes = findCandidates(submesh, swept_M, sigmas);
  if (candidates_.empty()) return {};

  const bool separated = candidates_.front().at_least > 0.0;
  double nearest = kMaxDeviations + kTolerance;
  for (const Candidate& candidate : candidates_) {
    beat();
    if (candidate.at_least > nearest - kTolerance) break;
    if (candidate.at_least <= 0.0 && reaches(kRounding, candidate, planes)) {
      return Clearance{separated, std::max(candidate.at_least, -kMaxDeviations)};
    }
    nearest = std::min(nearest, deviationsTo(nearest, candidate, planes));
  }
  if (nearest > kMaxDeviations) return {};
  return Clearance{separated, nearest};
}

bool ClearanceMeter::isNear(const Submesh& submesh, const SweptVolume& swept_M, const PerHalfSpace& sigmas) {
  const Planes planes = findCandidates(submesh, swept_M, sigmas);
  return std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    if (candidate.at_least > kMaxDeviations) return false;
    return candidate.at_most <= kMaxDeviations || reaches(kMaxDeviations, candidate, planes);
  });
}

const TriangleSet& ClearanceMeter::notSeparated() {
  not_separated_.clear();
  for (const Candidate& candidate : candidates_) {
    if (candidate.at_least <= 0.0) not_separated_.push_back((*remaining_)[candidate.number].triangle);
  }
  std::sort(not_separated_.begin(), not_separated_.end());
  return not_separated_;
}

// Bisects. Returns `nearest` if the candidate is not nearer.
double ClearanceMeter::deviationsTo(double nearest, const Candidate& candidate, const Planes& planes) const {
  double lower = std::max(candidate.at_least, 0.0);
  double upper = std::min(nearest - kTolerance, candidate.at_most);
  if (lower > upper || (upper < candidate.at_most && !reaches(upper, candidate, planes))) return nearest;
  if (reaches(lower + kRounding, candidate, planes)) return lower;
  while (upper - lower > kTolerance) {
    const double middle = 0.5 * (lower + upper);
    (reaches(middle, candidate, planes) ? upper : lower) = middle;
  }
  return upper;
}

// Returns whether the planes, moved out by z, enclose some of the triangle. Skips planes that enclose it wholly.
bool ClearanceMeter::reaches(double z, const Candidate& candidate, const Planes& planes) const {
  const size_t count = planes.count();
  const double* scores = &scores_[3 * candidate.number * count];
  ClippedTriangle remaining(planes.corners_B((*remaining_)[candidate.number].triangle));
  for (size_t i = 0; i < count && !remaining.empty(); ++i) {
    if (std::max({scores[i], scores[count + i], scores[2 * count + i]}) <= z) continue;
    const Planes::Plane& plane = planes.planes_B[i];
    remaining.cut(plane.normal, plane.offset + z * planes.sigmas[i]);
  }
  return !remaining.empty();
}

void ClearanceMeter::scoreCorners(const Planes& planes) {
  scores_.clear();
  for (const RemainingTriangle& candidate : *remaining_) {
    for (const Eigen::Vector3d& p_B : planes.corners_B(candidate.triangle)) {
      for (size_t i = 0; i < planes.count(); ++i) {
        scores_.push_back((planes.planes_B[i].normal.dot(p_B) - planes.planes_B[i].offset) / planes.sigmas[i]);
      }
    }
  }
}

// Collects the triangles that may need the fewest deviations, in this order. At the limit, a corner of one is enclosed.
void ClearanceMeter::collectCandidates(const Planes& planes) {
  const size_t count = planes.count();
  double limit = kMaxDeviations + kTolerance;
  candidates_.clear();
  for (size_t i = 0; i < remaining_->size(); ++i) {
    const double* const scores = &scores_[3 * i * count];
    double at_least = -std::numeric_limits<double>::infinity();
    for (size_t plane = 0; plane < count; ++plane) {
      at_least = std::max(at_least, std::min({scores[plane], scores[count + plane], scores[2 * count + plane]}));
    }
    if (at_least > limit) continue;
    double at_most = std::numeric_limits<double>::infinity();
    for (size_t corner = 0; corner < 3; ++corner) {
      at_most = std::min(at_most, *std::max_element(scores + corner * count, scores + (corner + 1) * count));
    }
    candidates_.push_back({i, at_least, at_most});
    limit = std::min(limit, std::max(0.0, at_most));
  }
  const auto too_far = [&](const Candidate& candidate) { return candidate.at_least > limit; };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), too_far), candidates_.end());
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& x, const Candidate& y) { return x.at_least < y.at_least; });
}

}  // namespace sweep_guard_core
