#include "soundness/body.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core::soundness {
namespace {

using Kind = Body::Kind;

Vector3r inBody(const Body& body, const Vector3r& p_T) {
  return body.X_TS.linear().transpose().cast<Real>() * (p_T - body.X_TS.translation().cast<Real>());
}

Vector3r inTool(const Body& body, const Vector3r& p_S) {
  return body.X_TS.linear().cast<Real>() * p_S + body.X_TS.translation().cast<Real>();
}

// A sphere is a point with padding.
Real paddingOf(const Body& body) {
  return static_cast<Real>(body.padding + (body.kind == Kind::kSphere ? body.radius : 0.0));
}

std::vector<Eigen::Vector3d> pointsOf(const Body& body) {
  return body.kind == Kind::kSphere ? std::vector<Eigen::Vector3d>{Eigen::Vector3d::Zero()} : body.points;
}

Vector3r coreSupport(const Body& body, const Vector3r& direction, Real inset) {
  if (body.kind == Kind::kCylinder) {
    const Real across = std::hypot(direction.x(), direction.y());
    const Real radius = across == 0 ? Real{0} : (static_cast<Real>(body.radius) - inset) / across;
    const Real z = direction.z() < 0 ? inset - static_cast<Real>(body.length) : -inset;
    return {radius * direction.x(), radius * direction.y(), z};
  }
  if (body.kind == Kind::kBox) {
    Vector3r p = body.half_extents.cast<Real>().array() - inset;
    for (int i = 0; i < 3; ++i) p[i] = std::copysign(p[i], direction[i]);
    return p;
  }
  const std::vector<Eigen::Vector3d> points = pointsOf(body);
  return std::max_element(points.begin(), points.end(),
                          [&](const auto& p, const auto& q) {
                            return direction.dot(p.template cast<Real>()) < direction.dot(q.template cast<Real>());
                          })
      ->template cast<Real>();
}

// The depth, or minus the distance, from the signed distances to the sides.
Real depthFrom(const Vector3r& distances) {
  return distances.maxCoeff() <= 0 ? -distances.maxCoeff() : -distances.cwiseMax(Real{0}).norm();
}

Real hullDepth(const Body& body, const Vector3r& p) {
  Real least = body.facets.empty() ? 0 : 1e30L;
  for (const Body::Facet& facet : body.facets) least = std::min(least, facet.offset - facet.normal.dot(p));
  return least;
}

Real coreDepth(const Body& body, const Vector3r& p) {
  if (body.kind == Kind::kSphere) return -p.norm();
  if (body.kind == Kind::kHull) return hullDepth(body, p);
  if (body.kind == Kind::kBox) return depthFrom(p.cwiseAbs() - body.half_extents.cast<Real>());
  const Real half = static_cast<Real>(body.length) / 2;
  return depthFrom({std::hypot(p.x(), p.y()) - static_cast<Real>(body.radius), std::abs(p.z() + half) - half, -half});
}

Vector3r coreNearest(const Body& body, Vector3r p) {
  switch (body.kind) {
    case Kind::kCylinder: {
      const Real across = std::hypot(p.x(), p.y());
      const Real scale = across > static_cast<Real>(body.radius) ? static_cast<Real>(body.radius) / across : Real{1};
      return {scale * p.x(), scale * p.y(), std::clamp(p.z(), -static_cast<Real>(body.length), Real{0})};
    }
    case Kind::kBox:
      return p.cwiseMin(body.half_extents.cast<Real>()).cwiseMax(-body.half_extents.cast<Real>());
    case Kind::kSphere:
      return Vector3r::Zero();
    default:
      for (int i = 0; i < 3; ++i) {
        for (const Body::Facet& facet : body.facets) {
          p -= std::max(facet.normal.dot(p) - facet.offset, Real{0}) * facet.normal;
        }
      }
      return p;
  }
}

Body randomBody(Random& random, double scale) {
  Body body;
  body.kind = static_cast<Kind>(random.below(4));
  body.radius = scale * random.logUniform(0.01, 1.0);
  body.length = scale * random.logUniform(0.01, 1.0);
  for (Eigen::Index i = 0; i < 3; ++i)
    body.half_extents[i] = random.chance(0.1) ? 0.0 : scale * random.logUniform(0.01, 1.0);
  body.half_extents.x() = std::max(body.half_extents.x(), 0.01 * scale);
  if (random.chance(0.8)) body.X_TS = random.pose(scale * random.uniform(0.0, 2.0) * random.direction());
  if (random.chance(0.5)) body.padding = scale * random.logUniform(1e-4, 0.3);
  if (body.kind != Kind::kHull) return body;
  const Eigen::Vector3d half = scale * Eigen::Vector3d(1.0, random.uniform(0.1, 1.0), random.chance(0.2) ? 0.0 : 0.5);
  for (int count = 1 + random.below(12); count > 0; --count) body.points.push_back(random.inBox(half));
  return withFacets(body);
}

ConvexShape shapeOf(const Body& body) {
  const auto unplaced = [&] {
    if (body.kind == Kind::kCylinder) return ConvexShape::cylinder(body.radius, body.length, body.sides);
    if (body.kind == Kind::kSphere) return ConvexShape::sphere(body.radius);
    if (body.kind == Kind::kBox) return ConvexShape::box(body.half_extents);
    return ConvexShape::hull(body.points);
  };
  const ConvexShape shape = unplaced().padded(body.padding);
  return body.X_TS.matrix().isIdentity(0.0) ? shape : shape.placed(body.X_TS);
}

}  // namespace

Body withFacets(Body hull) {
  hull.facets.clear();
  const auto& points = hull.points;
  Real size = 0;
  for (const Eigen::Vector3d& p : points) size = std::max(size, (p - points[0]).cast<Real>().norm());
  const Real flat = 1e-12L * size;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < points.size(); ++j) {
      for (size_t k = 0; k < std::min(i, j); ++k) {
        const Vector3r a = points[k].cast<Real>();
        Vector3r normal = (points[i].cast<Real>() - a).cross(points[j].cast<Real>() - a);
        if (i == j || normal.norm() <= flat * size) continue;
        normal.normalize();
        Real least = 0;
        Real most = 0;
        for (const Eigen::Vector3d& p : points) {
          least = std::min(least, normal.dot(p.cast<Real>() - a));
          most = std::max(most, normal.dot(p.cast<Real>() - a));
        }
        if (most <= flat && least < -flat) hull.facets.push_back({normal, normal.dot(a)});
      }
    }
  }
  return hull;
}

bool hasInset(const Body& body, Real inset) {
  const Real core_inset = inset - paddingOf(body);
  if (core_inset <= 0) return true;
  if (body.kind == Kind::kBox) return core_inset <= static_cast<Real>(body.half_extents.minCoeff());
  return body.kind == Kind::kCylinder && core_inset <= static_cast<Real>(body.radius) &&
         2 * core_inset <= static_cast<Real>(body.length);
}

Vector3r support(const Body& body, const Vector3r& direction_T, Real inset) {
  const Real outward = paddingOf(body) - inset;
  const Vector3r direction = body.X_TS.linear().transpose().cast<Real>() * direction_T;
  const Vector3r p_T = inTool(body, coreSupport(body, direction, std::max(-outward, Real{0})));
  return p_T + std::max(outward, Real{0}) * direction_T.normalized();
}

Real depth(const Body& body, const Vector3r& p_T) {
  const Real padding = paddingOf(body);
  const Real core = coreDepth(body, inBody(body, p_T));
  // Outside a hull, only a lower bound of the distance is known.
  if (body.kind == Kind::kHull && core <= 0) return std::min(core + padding, Real{0});
  return core + padding;
}

Vector3r nearest(const Body& body, const Vector3r& p_T) {
  const Vector3r core_T = inTool(body, coreNearest(body, inBody(body, p_T)));
  const Vector3r outward = p_T - core_T;
  const Real distance = outward.norm();
  return distance <= paddingOf(body) ? p_T : Vector3r(core_T + paddingOf(body) / distance * outward);
}

double extentOf(const Bodies& bodies) {
  double extent = 0.0;
  for (const Body& body : bodies) {
    double size = body.kind == Kind::kCylinder ? std::hypot(body.radius, body.length) : body.half_extents.norm();
    if (body.kind == Kind::kSphere) size = body.radius;
    if (body.kind == Kind::kHull) size = 0.0;
    for (const Eigen::Vector3d& p : body.points) size = std::max(size, p.norm());
    extent = std::max(extent, body.X_TS.translation().norm() + size + body.padding);
  }
  return extent;
}

Body scaled(Body body, double scale) {
  body.radius *= scale;
  body.length *= scale;
  body.half_extents *= scale;
  for (Eigen::Vector3d& p : body.points) p *= scale;
  for (Body::Facet& facet : body.facets) facet.offset *= static_cast<Real>(scale);
  body.X_TS.translation() *= scale;
  body.padding *= scale;
  return body;
}

Body enlarged(Body body, double more) {
  if (body.kind == Kind::kCylinder) {
    body.radius += more;
    body.length += more;
  } else {
    body.padding += more;
  }
  return body;
}

Tool toolOf(const Bodies& bodies) {
  if (bodies.size() == 1) return Tool(shapeOf(bodies.front()));
  std::vector<ConvexPiece> pieces;
  for (const Body& body : bodies) pieces.push_back({"", shapeOf(body)});
  return Tool(std::move(pieces));
}

Bodies randomBodies(Random& random, double scale) {
  if (random.chance(0.5)) {
    Bodies bodies;
    for (int count = 1 + random.below(5); count > 0; --count) bodies.push_back(randomBody(random, scale));
    return bodies;
  }
  Body body;
  const int kind = random.below(8);
  body.radius = kind == 0 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  body.length = kind == 1 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  body.sides = 3 + random.below(14);
  return {body};
}

}  // namespace sweep_guard_core::soundness
