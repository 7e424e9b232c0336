#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes.h"
#include "soundness/real.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core::soundness {

/// A convex piece of a tool, in the tool frame T, described by numbers. Both the product's shapes and the checks start
/// from these numbers; nothing here uses the product.
struct Body {
  enum class Kind { kCylinder, kSphere, kBox, kHull };
  struct Facet {
    Vector3r normal;  ///< unit, outward
    Real offset;      ///< [m]
  };

  Kind kind = Kind::kCylinder;
  double radius = 0.0;  ///< of a cylinder or a sphere [m]
  double length = 0.0;  ///< a cylinder fills z in [-length, 0] [m]
  int sides = 12;       ///< of the polygon that approximates a cylinder in the moments
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< of a box [m]
  std::vector<Eigen::Vector3d> points;                     ///< points of a hull [m]
  std::vector<Facet> facets;                               ///< facets of a hull, from withFacets()
  Eigen::Isometry3d X_TS = Eigen::Isometry3d::Identity();  ///< pose of the shape
  double padding = 0.0;                                    ///< the shape is grown by this [m]
};

using Bodies = std::vector<Body>;

/// Adds the planes that bound a hull; tries every three points. Adds none if all points lie in one plane.
Body withFacets(Body hull);

/// Returns whether some point lies at least `inset` [m] deep in the body.
bool hasInset(const Body& body, Real inset);

/// Returns the farthest point along a direction of any length, among the points at least `inset` [m] deep in the body.
Vector3r support(const Body& body, const Vector3r& direction_T, Real inset = 0);

/// Returns a lower bound of a point's depth in the body [m]. Negative: minus a lower bound of its distance. 0: unknown.
Real depth(const Body& body, const Vector3r& p_T);

/// Returns approximately the nearest point of the body.
Vector3r nearest(const Body& body, const Vector3r& p_T);

/// Returns a bound on the distance of the bodies' points from the origin of T [m].
double extentOf(const Bodies& bodies);

/// Returns the body with all lengths multiplied by a power of two.
Body scaled(Body body, double scale);

/// Returns a body that contains this one and is larger by up to `more` [m] on every side.
Body enlarged(Body body, double more);

/// Returns the product's tool made of these bodies.
Tool toolOf(const Bodies& bodies);

/// Returns bodies of about the size `scale` [m]: one cylinder, possibly flat or a needle; or one to five bodies of any
/// kind in random places.
Bodies randomBodies(Random& random, double scale);

}  // namespace sweep_guard_core::soundness
