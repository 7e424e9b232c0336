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

Eigen::Vector3d supportPoint(const Tool& tool, const Eigen::Vector3d& direction_T) {
  return direction_T.z() < 0.0 ? tool.rearExtreme(direction_T) : tool.frontExtreme(direction_T);
}

double deviationAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& r, const Matrix6d& covariance) {
  Eigen::Matrix<double, 6, 1> J;
  J << n, r.cross(n);
  return std::sqrt(std::max(0.0, J.dot(covariance * J)));
}

// No triangle of the mesh reaches the planes, for the ball around it does not.
bool outOfReach(const TriangleMesh& mesh_M, const BoxCoordinates& coordinates,
                const std::vector<HalfSpace>& half_spaces_B, const std::vector<double>& sigmas) {
  const Eigen::Vector3d center_B = coordinates.origin();
  for (size_t i = 0; i < half_spaces_B.size(); ++i) {
    if (half_spaces_B[i].signedDistance(center_B) - mesh_M.radius() > kMostDeviations * sigmas[i]) return true;
  }
  return false;
}

}  // namespace

double contactProbability(double deviations) {
  return deviations > kMostDeviations ? 0.0 : 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

std::vector<double> planeDeviations(const Tool& tool, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                                    const SweptVolume& swept_M) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  std::vector<double> sigmas;
  for (const HalfSpace& half_space_B : swept_M.halfSpaces_B()) {
    const Eigen::Vector3d n_M = R_MB * half_space_B.normal();
    const Eigen::Vector3d r_M = X_MT.linear() * supportPoint(tool, X_MT.linear().transpose() * n_M);
    sigmas.push_back(std::max(kLeastDeviation, deviationAlong(n_M, r_M, covariance_M)));
  }
  return sigmas;
}

std::optional<Clearance> ClearanceMeter::operator()(const TriangleMesh& mesh_M, const SweptVolume& swept_M,
                                                    const std::vector<double>& sigmas) {
  const BoxCoordinates coordinates(mesh_M, swept_M.box);
  const std::vector<HalfSpace> half_spaces_B = swept_M.grown(2.0 * coordinates.rounding()).halfSpaces_B();
  assert(sigmas.size() == half_spaces_B.size() && half_spaces_B.size() <= 16);
  if (outOfReach(mesh_M, coordinates, half_spaces_B, sigmas)) return {};

  scoreVertices(mesh_M, coordinates, half_spaces_B, sigmas);
  collectCandidates(mesh_M, half_spaces_B.size());
  if (candidates_.empty()) return {};
  double nearest = kMostDeviations + kTolerance;
  for (const Candidate& candidate : candidates_) {
    const double least = std::max(candidate.at_least, -kMostDeviations);
    if (least > nearest - kTolerance) break;
    const Triangle& triangle = mesh_M.triangles()[candidate.triangle];
    const auto& [a, b, c] = triangle;
    const Polygon corners_B = {coordinates(a), coordinates(b), coordinates(c)};
    const auto reaches = [&](double z) { return !within(z, corners_B, triangle, half_spaces_B, sigmas).empty(); };
    double upper = std::min(nearest - kTolerance, candidate.at_most);
    if (upper < candidate.at_most && !reaches(upper)) continue;
    double lower = least;
    if (reaches(least + kRounding)) upper = least;
    while (upper - lower > kTolerance) {
      const double middle = 0.5 * (lower + upper);
      (reaches(middle) ? upper : lower) = middle;
    }
    nearest = upper;
  }
  if (nearest > kMostDeviations) return {};
  return Clearance{candidates_.front().at_least > 0.0, nearest};
}

// What the planes enclose of a triangle once they are moved out. Most enclose it wholly: their scores say so.
Polygon ClearanceMeter::within(double z, Polygon polygon_B, const Triangle& triangle,
                               const std::vector<HalfSpace>& half_spaces_B, const std::vector<double>& sigmas) const {
  const size_t planes = half_spaces_B.size();
  for (size_t i = 0; i < planes && !polygon_B.empty(); ++i) {
    const bool cuts = std::any_of(triangle.begin(), triangle.end(),
                                  [&](std::uint32_t vertex) { return scores_[vertex * planes + i] > z; });
    if (cuts) polygon_B = clip(polygon_B, half_spaces_B[i].grown(z * sigmas[i]));
  }
  return polygon_B;
}

void ClearanceMeter::scoreVertices(const TriangleMesh& mesh_M, const BoxCoordinates& coordinates,
                                   const std::vector<HalfSpace>& half_spaces_B, const std::vector<double>& sigmas) {
  const size_t planes = half_spaces_B.size();
  scores_.resize(mesh_M.vertexCount() * planes);
  beyond_.resize(mesh_M.vertexCount());
  for (std::uint32_t vertex = 0; vertex < beyond_.size(); ++vertex) {
    const Eigen::Vector3d p_B = coordinates(vertex);
    unsigned bits = 0;
    for (size_t i = 0; i < planes; ++i) {
      const double score = half_spaces_B[i].signedDistance(p_B) / sigmas[i];
      scores_[vertex * planes + i] = score;
      bits |= static_cast<unsigned>(score > kMostDeviations) << i;
    }
    beyond_[vertex] = static_cast<std::uint16_t>(bits);
  }
}

// Those that might need fewest deviations first.
void ClearanceMeter::collectCandidates(const TriangleMesh& mesh_M, size_t planes) {
  candidates_.clear();
  const std::vector<Triangle>& triangles = mesh_M.triangles();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    if ((beyond_[a] & beyond_[b] & beyond_[c]) != 0) continue;
    const double* const scores[] = {&scores_[a * planes], &scores_[b * planes], &scores_[c * planes]};
    double at_least = -std::numeric_limits<double>::infinity();
    double at_most[] = {at_least, at_least, at_least};
    for (size_t plane = 0; plane < planes; ++plane) {
      at_least = std::max(at_least, std::min({scores[0][plane], scores[1][plane], scores[2][plane]}));
      for (size_t corner = 0; corner < 3; ++corner) at_most[corner] = std::max(at_most[corner], scores[corner][plane]);
    }
    candidates_.push_back({i, at_least, std::min({at_most[0], at_most[1], at_most[2]})});
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.at_least < b.at_least; });
}

}  // namespace sweep_guard
