#include "sweep_guard/geometry/link_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sweep_guard/geometry/convex_hull.h"

namespace sweep_guard_core {
namespace {

constexpr double kLeastDistance = 1e-5;  // [m]; much more than Qhull and float32 lose

std::vector<Eigen::Vector3d> verticesOf(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> vertices;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) vertices.push_back(mesh.vertex(i));
  return vertices;
}

// Returns the distance of the nearest face from a point inside, of those that lie along an axis, if one is given.
double nearestFace(const ConvexHull& hull, const Eigen::Vector3d& p, const std::optional<Eigen::Vector3d>& axis) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : hull.triangles) {
    const Eigen::Vector3d normal =
        (hull.corners[b] - hull.corners[a]).cross(hull.corners[c] - hull.corners[a]).normalized();
    const bool counts = !normal.isZero(0.0) && (!axis || std::abs(normal.dot(*axis)) < 0.5);
    if (counts) nearest = std::min(nearest, normal.dot(hull.corners[a] - p));
  }
  return nearest;
}

// The support functions of a ball, or of a disc, and of what they contain differ by no more than that of the nearest face.
double lackOf(const ConvexShape& shape, const ConvexHull& hull) {
  const double rest = kLeastDistance + hull.hull_tolerance + shape.mesh_T().rounding();
  const auto beyond = [&](double radius, const Eigen::Vector3d& center, const std::optional<Eigen::Vector3d>& axis) {
    const double face = hull.solid ? nearestFace(hull, center, axis) : 0.0;
    return std::max(0.0, radius - std::min(radius, face));
  };
  if (const auto* const cylinder = shape.asCylinder()) {
    const Eigen::Vector3d middle = shape.X_TS() * Eigen::Vector3d(0.0, 0.0, -0.5 * cylinder->length);
    return shape.padding() + beyond(cylinder->radius, middle, shape.X_TS().linear().col(2)) + rest;
  }
  if (shape.isBall())
    return beyond(shape.padding(), shape.coreSupportPoint(Eigen::Vector3d::UnitX()), std::nullopt) + rest;
  return shape.padding() + rest;
}

// Returns the corners of an icosahedron around a ball.
std::vector<Eigen::Vector3d> icosahedronAround(double radius) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  const double scale = radius * std::sqrt(3.0) / (golden * golden);  // of corners like (0, 1, golden)
  std::vector<Eigen::Vector3d> corners;
  for (const double one : {-scale, scale}) {
    for (const double other : {-golden * scale, golden * scale}) {
      corners.emplace_back(0.0, one, other);
      corners.emplace_back(one, other, 0.0);
      corners.emplace_back(other, 0.0, one);
    }
  }
  return corners;
}

// The sum of the mesh of a piece and of a ball holds the piece.
ConvexHull hullAround(const ConvexShape& shape) {
  const ConvexHull inner = convexHull(verticesOf(shape.mesh_T()));
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& around : icosahedronAround(lackOf(shape, inner))) {
    for (const Eigen::Vector3d& corner : inner.corners) points.emplace_back(corner + around);
  }
  return convexHull(points);
}

LinkSurface& surfaceOf(const std::string& link, std::vector<LinkSurface>& surfaces) {
  const auto same = [&](const LinkSurface& surface) { return surface.link == link; };
  const auto known = std::find_if(surfaces.begin(), surfaces.end(), same);
  if (known != surfaces.end()) return *known;
  surfaces.push_back({link, {}, {}});
  return surfaces.back();
}

}  // namespace

std::vector<LinkSurface> linkSurfaces(const Tool& body_B) {
  std::vector<LinkSurface> surfaces;
  for (const ConvexPiece& piece : body_B.pieces()) {
    LinkSurface& surface = surfaceOf(piece.link, surfaces);
    const ConvexHull hull = hullAround(piece.shape_T);
    const auto first = static_cast<std::uint32_t>(surface.vertices_B.size());
    surface.vertices_B.insert(surface.vertices_B.end(), hull.corners.begin(), hull.corners.end());
    for (const auto& [a, b, c] : hull.triangles) surface.triangles.push_back({first + a, first + b, first + c});
  }
  return surfaces;
}

}  // namespace sweep_guard_core
