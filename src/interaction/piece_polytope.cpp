#include "interaction/piece_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape_surface.h"
#include "sweep_guard/geometry/convex_hull.h"

namespace sweep_guard_core {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSamePlane = 2e-7;  // of the radius: corners so near to a face lie in it; float32 rounds by 6e-8
constexpr double kSameNormal = 0.999;
constexpr double kThin = 1e-9;  // of the radius: less thick is flat

using HalfSpaces = std::vector<HalfSpace>;

HalfSpaces prism(const ConvexShape& shape_T, const ConvexShape::Cylinder& cylinder, int sides) {
  const double angle = 2.0 * kPi / sides;
  const double padding = shape_T.padding();
  const double circumradius = (cylinder.radius + padding) * std::sqrt(angle / std::sin(angle));
  const Eigen::Isometry3d X_TS = shape_T.X_TS();
  HalfSpaces faces;
  const auto add = [&](const Eigen::Vector3d& normal_S, double offset) {
    const Eigen::Vector3d normal_T = X_TS.linear() * normal_S;
    faces.emplace_back(normal_T, offset + normal_T.dot(X_TS.translation()));
  };
  add(Eigen::Vector3d::UnitZ(), padding);
  add(-Eigen::Vector3d::UnitZ(), cylinder.length + padding);
  for (int i = 0; i < sides; ++i) {
    const double at = (i + 0.5) * angle;
    add({std::cos(at), std::sin(at), 0.0}, circumradius * std::cos(0.5 * angle));
  }
  return faces;
}

HalfSpaces sidesOf(const ConvexShape& shape_T, const ConvexShape::Box& half_extents) {
  const Eigen::Isometry3d X_TS = shape_T.X_TS();
  HalfSpaces faces;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d normal_T = X_TS.linear().col(i);
    const double at = normal_T.dot(X_TS.translation());
    faces.emplace_back(normal_T, at + half_extents[i] + shape_T.padding());
    faces.emplace_back(-normal_T, -at + half_extents[i] + shape_T.padding());
  }
  return faces;
}

double radiusOf(const std::vector<Eigen::Vector3d>& points) {
  double radius = 0.0;
  for (const Eigen::Vector3d& p : points) radius = std::max(radius, (p - points.front()).norm());
  return radius;
}

// The largest triangles first: their normals have the most exact digits.
std::vector<Triangle> bySize(const ConvexHull& hull) {
  const auto& p = hull.corners;
  const auto area = [&](const Triangle& t) { return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).squaredNorm(); };
  std::vector<Triangle> triangles = hull.triangles;
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const Triangle& a, const Triangle& b) { return area(a) > area(b); });
  return triangles;
}

HalfSpaces facesOf(const ConvexHull& hull, double padding) {
  const auto& p = hull.corners;
  const double tolerance = kSamePlane * radiusOf(p);
  HalfSpaces faces;
  for (const auto& [a, b, c] : bySize(hull)) {
    const Eigen::Vector3d across = (p[b] - p[a]).cross(p[c] - p[a]);
    const double length = across.norm();
    const auto contains = [&, a = a, b = b, c = c](const HalfSpace& face) {
      const double out = std::min({face.signedDistance(p[a]), face.signedDistance(p[b]), face.signedDistance(p[c])});
      return out > -tolerance && face.normal().dot(across) >= kSameNormal * length;
    };
    if (length < tolerance * tolerance || std::any_of(faces.begin(), faces.end(), contains)) continue;
    const Eigen::Vector3d normal = across / length;
    double offset = normal.dot(p[a]);
    for (const Eigen::Vector3d& corner : p) offset = std::max(offset, normal.dot(corner));
    faces.emplace_back(normal, offset);
  }
  for (HalfSpace& face : faces) face = face.grown(padding);
  return faces;
}

double ballEnlargement(const TriangleSurface& ball) {
  return std::cbrt(4.0 / 3.0 * kPi / volume(convexHull(ball.vertices)));
}

// Without corners that enclose a volume, what is there is mostly padding.
HalfSpaces roundFaces(const ConvexShape& shape_T) {
  const TriangleSurface ball = sphereSurface(1.0);
  const double padding = shape_T.padding() * ballEnlargement(ball);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& direction : ball.vertices) {
    points.emplace_back(shape_T.coreSupportPoint(direction) + padding * direction);
  }
  const ConvexHull hull = convexHull(points);
  return hull.solid ? facesOf(hull, 0.0) : HalfSpaces();
}

bool isPointOrSegment(const ConvexShape& shape_T) {
  const Eigen::Vector3d along = shape_T.axis_T();
  const double length = shape_T.support(along) + shape_T.support(-along) - 2.0 * shape_T.padding();
  const Eigen::Vector3d across = along.unitOrthogonal();
  const double width = shape_T.support(across) + shape_T.support(-across) - 2.0 * shape_T.padding();
  return width <= kThin * (length + shape_T.padding());
}

HalfSpaces facesOf(const ConvexShape& shape_T) {
  const TriangleMesh& mesh_T = shape_T.mesh_T();
  if (const auto* const cylinder = shape_T.asCylinder()) {
    return prism(shape_T, *cylinder, static_cast<int>(mesh_T.vertexCount()) / 2 - 1);
  }
  if (const auto* const box = shape_T.asBox()) return sidesOf(shape_T, *box);
  if (isPointOrSegment(shape_T)) return roundFaces(shape_T);
  std::vector<Eigen::Vector3d> points;
  for (size_t i = 0; i < mesh_T.vertexCount(); ++i) points.push_back(mesh_T.vertex(i));
  const ConvexHull hull = convexHull(points);
  return hull.solid ? facesOf(hull, shape_T.padding()) : roundFaces(shape_T);
}

}  // namespace

PiecePolytope::PiecePolytope(const ConvexShape& shape_T) {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  for (int i = 0; i < 3; ++i) {
    upper[i] = shape_T.support(Eigen::Vector3d::Unit(i));
    lower[i] = -shape_T.support(-Eigen::Vector3d::Unit(i));
  }
  center_T_ = 0.5 * (lower + upper);
  axis_ = shape_T.axis_T().z() > 0.0 ? Eigen::Vector3d(-shape_T.axis_T()) : shape_T.axis_T();
  const double radius = (upper - lower).norm();
  half_spaces_ = facesOf(shape_T);
  for (HalfSpace& face : half_spaces_) face = face.grown(-face.normal().dot(center_T_));
  faces_ = polytopeFaces(half_spaces_, radius);
  volume_ = polytopeVolume(faces_);
  if (volume_ > kThin * std::pow(radius, 3)) return;
  volume_ = 0.0;
  half_spaces_.clear();
  faces_.clear();
}

double PiecePolytope::support(const Eigen::Vector3d& direction) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Polygon& face : faces_) {
    for (const Eigen::Vector3d& corner : face) most = std::max(most, direction.dot(corner));
  }
  return most;
}

}  // namespace sweep_guard_core
