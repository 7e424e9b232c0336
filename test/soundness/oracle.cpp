#include "soundness/oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "detection/exact_oracle.h"
#include "soundness/real.h"

namespace sweep_guard_core::soundness {
namespace {

using Distances = std::array<Real, 3>;  // of the corners from one plane [m]; positive: outside
using Weights = std::array<Real, 3>;    // barycentric weights of a point of the triangle

struct Problem {
  std::vector<Distances> planes;
  Real error;  // error bound of all distances
};

Real at(const Distances& plane, const Weights& w) { return w[0] * plane[0] + w[1] * plane[1] + w[2] * plane[2]; }

Problem problemOf(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth) {
  const Matrix3r R_BM = swept_M.box.X_MB.linear().transpose().cast<Real>();
  const Vector3r center = swept_M.box.X_MB.translation().cast<Real>();
  const Vector3r origin = mesh_M.origin().cast<Real>();
  std::array<Vector3r, 3> corners_B;
  Real largest = center.cwiseAbs().sum() + origin.cwiseAbs().sum();
  Real farthest = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3r offset = mesh_M.offset(mesh_M.triangles()[triangle][i]).cast<Real>();
    farthest = std::max(farthest, offset.cwiseAbs().sum());
    corners_B[i] = R_BM * (origin + offset - center);
  }
  largest += farthest;

  Problem problem;
  Real deepest = 0;
  const auto add = [&](const Vector3r& normal, double offset) {
    const Real d = static_cast<Real>(offset) + static_cast<Real>(growth);
    deepest = std::max(deepest, std::abs(d));
    problem.planes.push_back(
        {normal.dot(corners_B[0]) - d, normal.dot(corners_B[1]) - d, normal.dot(corners_B[2]) - d});
  };
  for (const HalfSpace& half_space : swept_M.halfSpaces_B()) {
    add(half_space.normal().cast<Real>(), half_space.offset());
  }
  // Twelve sums and products, each with an error of 2^-64 of its largest number: 2^-58 is four times their sum.
  problem.error = 0x1p-58L * (largest + deepest);
  return problem;
}

// Finds a point by clipping and checks that it lies well inside every plane.
bool surelyMeets(const Problem& problem) {
  std::vector<Weights> polygon = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Weights> inside;
  for (const Distances& plane : problem.planes) {
    inside.clear();
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Weights& p = polygon[i];
      const Weights& q = polygon[(i + 1) % polygon.size()];
      const Real distance_p = at(plane, p);
      const Real distance_q = at(plane, q);
      if (distance_p <= 0) inside.push_back(p);
      if ((distance_p < 0 && distance_q > 0) || (distance_p > 0 && distance_q < 0)) {
        const Real s = distance_p / (distance_p - distance_q);
        inside.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
      }
    }
    polygon.swap(inside);
    if (polygon.empty()) return false;
  }
  Weights middle = {0, 0, 0};
  for (const Weights& w : polygon) {
    for (size_t i = 0; i < 3; ++i) middle[i] += std::max(w[i], Real{0});
  }
  const Real sum = middle[0] + middle[1] + middle[2];
  for (Real& w : middle) w /= sum;
  return std::all_of(problem.planes.begin(), problem.planes.end(),
                     [&](const Distances& plane) { return at(plane, middle) < -2 * problem.error; });
}

bool allBeyond(const Distances& plane, Real error) { return plane[0] > error && plane[1] > error && plane[2] > error; }

// If the whole triangle lies beyond a mean of both planes, no point of it is inside both.
bool beyondMean(const Distances& a, const Distances& b, Real error) {
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    // The mean from which two corners have equal distances.
    const Real share = (b[j] - b[i]) / ((a[i] - b[i]) - (a[j] - b[j]));
    if (!(share >= 0 && share <= 1)) continue;
    Distances mean;
    for (size_t k = 0; k < 3; ++k) mean[k] = share * a[k] + (1 - share) * b[k];
    if (allBeyond(mean, error)) return true;
  }
  return false;
}

bool beyondMean(const Distances& a, const Distances& b, const Distances& c, Real error) {
  Matrix3r distances;
  for (int i = 0; i < 3; ++i) {
    const auto corner = static_cast<size_t>(i);
    distances.row(i) << a[corner], b[corner], c[corner];
  }
  Vector3r shares = distances.inverse() * Vector3r::Ones();
  if (!(shares.minCoeff() >= 0)) return false;
  shares /= shares.sum();
  const Vector3r mean = distances * shares;
  return mean.minCoeff() > error;
}

bool surelyMisses(const Problem& problem) {
  const std::vector<Distances>& planes = problem.planes;
  const Real error = 2 * problem.error;
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (beyondMean(planes[i], planes[j], error)) return true;
    }
  }
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        if (beyondMean(planes[i], planes[j], planes[k], error)) return true;
      }
    }
  }
  return false;
}

}  // namespace

bool meets(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth) {
  const Problem problem = problemOf(mesh_M, triangle, swept_M, growth);
  for (const Distances& plane : problem.planes) {
    if (allBeyond(plane, problem.error)) return false;
  }
  if (surelyMeets(problem)) return true;
  if (surelyMisses(problem)) return false;
  return meetsExactly(mesh_M, triangle, swept_M, growth);
}

}  // namespace sweep_guard_core::soundness
