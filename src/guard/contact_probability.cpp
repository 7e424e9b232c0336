#include "sweep_guard/guard/contact_probability.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "sweep_guard/detection/box_coordinates.h"

namespace sweep_guard {
namespace {

constexpr double kLeastDeviation = 1e-9;  // [m]; what is surer than this is sure
constexpr double kTolerance = 1e-3;       // [standard deviations]
constexpr double kRounding = 1e-6;        // of clipping [standard deviations]

double deviationAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& r, const Matrix6d& covariance) {
  Eigen::Matrix<double, 6, 1> J;
  J << n, r.cross(n);
  return std::sqrt(std::max(0.0, J.dot(covariance * J)));
}

// Of the tool's support along a unit direction. The farther end lags behind by `gap`; within kMostDeviations of its own
// it catches up with whichever is larger of these.
double supportDeviation(const ConvexShape& shape, const Eigen::Matrix3d& R_MT, const Eigen::Vector3d& n_M,
                        const Matrix6d& covariance_M) {
  const Eigen::Vector3d n_T = R_MT.transpose() * n_M;
  const Eigen::Vector3d front_T = shape.frontExtreme(n_T);
  const Eigen::Vector3d rear_T = shape.rearExtreme(n_T);
  const double front = deviationAlong(n_M, R_MT * front_T, covariance_M);
  const double rear = deviationAlong(n_M, R_MT * rear_T, covariance_M);
  const double ahead = n_T.dot(front_T - rear_T);
  const double gap = std::abs(ahead);
  const auto& [touching, other] = ahead < 0.0 ? std::pair(rear, front) : std::pair(front, rear);
  return std::max(touching, other - gap / kMostDeviations);
}

}  // namespace

double contactProbability(double deviations) {
  return deviations > kMostDeviations ? 0.0 : 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

std::vector<double> planeDeviations(const ConvexShape& shape, const Eigen::Isometry3d& X_MT,
                                    const Matrix6d& covariance_M, const SweptVolume& swept_M) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  std::vector<double> sigmas;
  for (const HalfSpace& half_space_B : swept_M.halfSpaces_B()) {
    const Eigen::Vector3d n_M = R_MB * half_space_B.normal();
    sigmas.push_back(std::max(kLeastDeviation, supportDeviation(shape, X_MT.linear(), n_M, covariance_M)));
  }
  return sigmas;
}

struct ClearanceMeter::Planes {
  BoxCoordinates coordinates;
  std::vector<HalfSpace> half_spaces_B;
  const std::vector<double>& sigmas;

  size_t count() const { return sigmas.size(); }
  HalfSpace movedOut(size_t i, double z) const { return half_spaces_B[i].grown(z * sigmas[i]); }

  // Normals and offsets, in standard deviations: a division per vertex and plane would cost most of the time.
  std::vector<Eigen::Vector4d> perDeviation() const {
    std::vector<Eigen::Vector4d> scales;
    for (size_t i = 0; i < count(); ++i) {
      scales.emplace_back();
      scales.back() << half_spaces_B[i].normal() / sigmas[i], half_spaces_B[i].offset() / sigmas[i];
    }
    return scales;
  }
};

std::optional<Clearance> ClearanceMeter::operator()(const TriangleMesh& mesh_M, const MeshPart& part,
                                                    const SweptVolume& swept_M, const std::vector<double>& sigmas) {
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  const Planes planes{coordinates, swept_M.grown(2.0 * coordinates.rounding()).halfSpaces_B(), sigmas};
  assert(planes.half_spaces_B.size() == planes.count() && planes.count() <= 16);
  scoreVertices(part, planes);
  collectCandidates(part, planes);
  if (candidates_.empty()) return {};

  const bool separated = candidates_.front().at_least > 0.0;
  double nearest = kMostDeviations + kTolerance;
  for (const Candidate& candidate : candidates_) {
    if (candidate.at_least > nearest - kTolerance) break;
    if (candidate.at_least <= 0.0 && reaches(kRounding, part, candidate, planes)) {
      return Clearance{separated, std::max(candidate.at_least, -kMostDeviations)};
    }
    nearest = std::min(nearest, outwards(nearest, part, candidate, planes));
  }
  if (nearest > kMostDeviations) return {};
  return Clearance{separated, nearest};
}

std::vector<std::uint32_t> ClearanceMeter::notSeparated(const MeshPart& part) const {
  std::vector<std::uint32_t> left;
  for (const Candidate& candidate : candidates_) {
    if (candidate.at_least <= 0.0) left.push_back(part.triangles[candidate.triangle]);
  }
  std::sort(left.begin(), left.end());
  return left;
}

// By bisection; not less than `nearest` if it makes no difference.
double ClearanceMeter::outwards(double nearest, const MeshPart& part, const Candidate& candidate,
                                const Planes& planes) const {
  double lower = std::max(candidate.at_least, 0.0);
  double upper = std::min(nearest - kTolerance, candidate.at_most);
  if (lower > upper || (upper < candidate.at_most && !reaches(upper, part, candidate, planes))) return nearest;
  if (reaches(lower + kRounding, part, candidate, planes)) return lower;
  while (upper - lower > kTolerance) {
    const double middle = 0.5 * (lower + upper);
    (reaches(middle, part, candidate, planes) ? upper : lower) = middle;
  }
  return upper;
}

// Whether the planes enclose anything of a triangle once they are moved out. Most enclose it wholly: their scores say
// so.
bool ClearanceMeter::reaches(double z, const MeshPart& part, const Candidate& candidate, const Planes& planes) const {
  const Triangle& corners = part.corners[candidate.triangle];
  Polygon polygon_B;
  for (const std::uint32_t corner : corners) polygon_B.push_back(planes.coordinates(part.vertices[corner]));
  for (size_t i = 0; i < planes.count() && !polygon_B.empty(); ++i) {
    const auto beyond = [&](std::uint32_t corner) { return scores_[corner * planes.count() + i] > z; };
    if (std::any_of(corners.begin(), corners.end(), beyond)) polygon_B = clip(polygon_B, planes.movedOut(i, z));
  }
  return !polygon_B.empty();
}

void ClearanceMeter::scoreVertices(const MeshPart& part, const Planes& planes) {
  const size_t count = planes.count();
  const std::vector<Eigen::Vector4d> scales = planes.perDeviation();
  scores_.resize(part.vertices.size() * count);
  beyond_.resize(part.vertices.size());
  for (size_t vertex = 0; vertex < beyond_.size(); ++vertex) {
    const Eigen::Vector3d p_B = planes.coordinates(part.vertices[vertex]);
    unsigned bits = 0;
    for (size_t i = 0; i < count; ++i) {
      const double score = scales[i].head<3>().dot(p_B) - scales[i][3];
      scores_[vertex * count + i] = score;
      bits |= static_cast<unsigned>(score > kMostDeviations) << i;
    }
    beyond_[vertex] = static_cast<std::uint16_t>(bits);
  }
}

// Those that may need fewest deviations, in this order: at the limit a corner of one of them is enclosed.
void ClearanceMeter::collectCandidates(const MeshPart& part, const Planes& planes) {
  const size_t count = planes.count();
  double limit = kMostDeviations + kTolerance;
  candidates_.clear();
  for (size_t i = 0; i < part.corners.size(); ++i) {
    const auto& [a, b, c] = part.corners[i];
    if ((beyond_[a] & beyond_[b] & beyond_[c]) != 0) continue;
    const double* const scores[] = {&scores_[a * count], &scores_[b * count], &scores_[c * count]};
    double at_least = -std::numeric_limits<double>::infinity();
    for (size_t plane = 0; plane < count; ++plane) {
      at_least = std::max(at_least, std::min({scores[0][plane], scores[1][plane], scores[2][plane]}));
    }
    if (at_least > limit) continue;
    double at_most = std::numeric_limits<double>::infinity();
    for (const double* corner : scores) at_most = std::min(at_most, *std::max_element(corner, corner + count));
    candidates_.push_back({i, at_least, at_most});
    limit = std::min(limit, std::max(0.0, at_most));
  }
  const auto too_far = [&](const Candidate& candidate) { return candidate.at_least > limit; };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), too_far), candidates_.end());
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& x, const Candidate& y) { return x.at_least < y.at_least; });
}

}  // namespace sweep_guard
