#include "sweep_guard/geometry/convex_hull.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "common/floating_point.h"
#include "geometry/qhull.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kMaxHullTolerance = 1e-9;  // relative to the extent

void checkPoints(const Points& points) {
  if (points.empty()) throw InvalidInput("no points: a convex hull needs at least one");
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].cwiseAbs().maxCoeff() <= kMaxCoordinate && points[i].allFinite()) continue;
    throw InvalidInput("point " + std::to_string(i) + " is NaN, infinite or beyond 1e7 m: give finite positions");
  }
}

Points distinct(Points points) {
  const auto key = [](const Eigen::Vector3d& p) { return std::make_tuple(p.x(), p.y(), p.z()); };
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// The points relative to their center, to keep their digits.
Eigen::Matrix3Xd centered(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  Eigen::Matrix3Xd about(3, points.size());
  for (size_t i = 0; i < points.size(); ++i) about.col(static_cast<Eigen::Index>(i)) = points[i] - box.center();
  return about;
}

double extentOf(const Eigen::Matrix3Xd& about) { return std::sqrt(about.colwise().squaredNorm().maxCoeff()); }

// The coordinates along the principal axes, the longest first, scaled to about 1: Qhull has absolute tolerances.
Eigen::Matrix3Xd principalCoordinates(const Eigen::Matrix3Xd& about) {
  const Eigen::Matrix3Xd scaled = about / extentOf(about);
  const Eigen::Vector3d mean = scaled.rowwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> deviation(scaled.colwise() - mean, Eigen::ComputeFullU);
  Eigen::Matrix3d axes = deviation.matrixU();
  axes.col(2) *= axes.determinant() < 0.0 ? -1.0 : 1.0;
  return axes.transpose() * scaled;
}

std::optional<std::vector<Facet>> facetsOf(const Eigen::Matrix3Xd& principal, int dimensions) {
  if (principal.cols() <= dimensions) return std::nullopt;
  return hullFacets(principal.topRows(dimensions));
}

// The two ends of points on a line.
std::vector<Facet> endsOf(const Eigen::Matrix3Xd& principal) {
  Eigen::Index first = 0;
  Eigen::Index last = 0;
  principal.row(0).minCoeff(&first);
  principal.row(0).maxCoeff(&last);
  return {{static_cast<std::uint32_t>(first)}, {static_cast<std::uint32_t>(last)}};
}

Facet allCorners(const std::vector<Facet>& facets) {
  Facet corners;
  for (const Facet& facet : facets) corners.insert(corners.end(), facet.begin(), facet.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// The hull as simplices from its center to its facets, for convex combinations near a point.
class Simplices {
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

 public:
  Simplices(const Eigen::Matrix3Xd& about, const std::vector<Facet>& facets) {
    const Facet corners = allCorners(facets);
    for (const std::uint32_t corner : corners) center_ += about.col(corner) / static_cast<double>(corners.size());
    for (const Facet& facet : facets) add(about, facet);
  }

  // Returns a bound on the distance of a point from the hull, except for the rounding of the sums. A point of the hull
  // lies in the simplex whose facet is ahead of it, as seen from the center.
  double distanceBound(const Eigen::Vector3d& p, double negligible) const {
    double least = (p - center_).norm();
    if (weight_sums_.empty()) return least;
    least = std::min(least, distanceFrom(weight_sums_.largest(p - center_), p));
    for (size_t i = 0; i < spans_.size() && least > negligible; ++i) least = std::min(least, distanceFrom(i, p));
    return least;
  }

 private:
  void add(const Eigen::Matrix3Xd& about, const Facet& facet) {
    Eigen::MatrixXd span(3, facet.size());
    for (size_t i = 0; i < facet.size(); ++i) span.col(static_cast<Eigen::Index>(i)) = about.col(facet[i]) - center_;
    const Eigen::MatrixXd inverse = span.completeOrthogonalDecomposition().pseudoInverse();
    if (!inverse.allFinite()) return;
    spans_.emplace_back(span);
    inverses_.emplace_back(inverse);
    weight_sums_.add(inverse.colwise().sum().transpose(), 0.0);
  }

  double distanceFrom(size_t simplex, const Eigen::Vector3d& p) const {
    Weights weights = (inverses_[simplex] * (p - center_)).cwiseMax(0.0);
    weights /= std::max(1.0, weights.sum());
    return (p - center_ - spans_[simplex] * weights).norm();
  }

  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>> spans_;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3>> inverses_;
  LinearFunctions weight_sums_;
};

double hullTolerance(const Eigen::Matrix3Xd& about, const std::vector<Facet>& facets) {
  const Facet corners = allCorners(facets);
  // Each weight and each sum may have one rounding error per corner.
  const double of_sums = static_cast<double>(corners.size() + 32) * kEpsilon * extentOf(about);
  const Simplices simplices(about, facets);
  double farthest = 0.0;
  for (std::uint32_t i = 0; i < about.cols(); ++i) {
    if (std::binary_search(corners.begin(), corners.end(), i)) continue;
    farthest = std::max(farthest, simplices.distanceBound(about.col(i), 0.1 * of_sums));
  }
  return farthest + of_sums;
}

std::vector<Triangle> fan(size_t corners) {
  const auto last = static_cast<std::uint32_t>(corners - 1);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 1; i < last; ++i) triangles.push_back({0, i, i + 1});
  if (triangles.empty()) triangles.push_back({0, last, last});
  return triangles;
}

ConvexHull everyPoint(const Points& points) { return {points, fan(points.size()), 0.0, false}; }

// Returns the corners of a flat hull in order around it.
Facet sortedAround(const Eigen::Matrix3Xd& principal, Facet corners) {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const std::uint32_t i : corners) center += principal.col(i).head<2>() / static_cast<double>(corners.size());
  const auto angle = [&](std::uint32_t i) {
    return std::atan2(principal(1, i) - center.y(), principal(0, i) - center.x());
  };
  std::sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
  return corners;
}

std::vector<Triangle> renumbered(const std::vector<Facet>& facets, const Facet& corners) {
  const auto number = [&](std::uint32_t i) {
    return static_cast<std::uint32_t>(std::lower_bound(corners.begin(), corners.end(), i) - corners.begin());
  };
  std::vector<Triangle> triangles;
  triangles.reserve(facets.size());
  for (const Facet& facet : facets) triangles.push_back({number(facet[0]), number(facet[1]), number(facet[2])});
  return triangles;
}

// Returns no hull if the points span fewer dimensions or the hull is not near enough to them.
std::optional<ConvexHull> hullOf(const Points& points, const Eigen::Matrix3Xd& about, const Eigen::Matrix3Xd& principal,
                                 int dimensions) {
  const std::optional<std::vector<Facet>> facets =
      dimensions == 1 ? endsOf(principal) : facetsOf(principal, dimensions);
  if (!facets) return std::nullopt;
  const double hull_tolerance = hullTolerance(about, *facets);
  if (hull_tolerance > kMaxHullTolerance * extentOf(about)) return std::nullopt;
  Facet corners = allCorners(*facets);
  ConvexHull hull{{}, {}, hull_tolerance, dimensions == 3};
  hull.triangles = hull.solid ? renumbered(*facets, corners) : fan(corners.size());
  if (dimensions == 2) corners = sortedAround(principal, corners);
  for (const std::uint32_t i : corners) hull.corners.push_back(points[i]);
  return hull;
}

}  // namespace

ConvexHull convexHull(const std::vector<Eigen::Vector3d>& points) {
  checkPoints(points);
  const Points given = distinct(points);
  if (given.size() == 1) return everyPoint(given);
  const Eigen::Matrix3Xd about = centered(given);
  const Eigen::Matrix3Xd principal = principalCoordinates(about);
  for (const int dimensions : {3, 2, 1}) {
    if (std::optional<ConvexHull> hull = hullOf(given, about, principal, dimensions)) return *std::move(hull);
  }
  return everyPoint(given);
}

double volume(const ConvexHull& hull) {
  if (!hull.solid) return 0.0;
  const Eigen::Vector3d& apex = hull.corners.front();
  double sum = 0.0;
  for (const auto& [a, b, c] : hull.triangles) {
    sum += (hull.corners[a] - apex).cross(hull.corners[b] - apex).dot(hull.corners[c] - apex) / 6.0;
  }
  return sum;
}

double surface(const ConvexHull& hull) {
  double sum = 0.0;
  for (const auto& [a, b, c] : hull.triangles) {
    sum += (hull.corners[b] - hull.corners[a]).cross(hull.corners[c] - hull.corners[a]).norm() / 2.0;
  }
  return hull.solid ? sum : 2.0 * sum;
}

}  // namespace sweep_guard_core
