#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes.h"
#include "soundness/real.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core::soundness {

/// A convex part of a tool, in the tool frame T, told in numbers: what the product's shapes are made from, and all that
/// the checks know of it. Nothing here asks the product.
struct Body {
  enum class Kind { kCylinder, kSphere, kBox, kHull };
  struct Facet {
    Vector3r normal;  ///< unit, outward
    Real offset;      ///< [m]
  };

  Kind kind = Kind::kCylinder;
  double radius = 0.0;                                     ///< of a cylinder or a sphere [m]
  double length = 0.0;                                     ///< a cylinder fills z in [-length, 0] [m]
  int sides = 12;                                          ///< of the polygon that stands for a cylinder in statistics
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< of a box [m]
  std::vector<Eigen::Vector3d> points;                     ///< a hull is that of these [m]
  std::vector<Facet> facets;                               ///< of a hull: see withFacets()
  Eigen::Isometry3d X_TS = Eigen::Isometry3d::Identity();  ///< where all this is
  double padding = 0.0;                                    ///< grown by this [m]
};

using Bodies = std::vector<Body>;

/// A hull with the planes that bound it, found by trying every three points; without any if the points lie in a plane.
Body withFacets(Body hull);

/// Whether some points of the body have all points within `inset` [m] of them in the body, too.
bool hasInset(const Body& body, Real inset);

/// Of the points that lie at least `inset` [m] deep in the body, one that is farthest along a direction of any length.
Vector3r support(const Body& body, const Vector3r& direction_T, Real inset = 0);

/// How deep a point lies in the body [m], for certain; negative: it is outside, at least so far away. 0: not known.
Real depth(const Body& body, const Vector3r& p_T);

/// A point of the body or close to it that is about as near to a point as any.
Vector3r nearest(const Body& body, const Vector3r& p_T);

/// Bound on the distance of a point of the bodies from the origin of T [m].
double extentOf(const Bodies& bodies);

/// The body with all lengths times a power of two.
Body scaled(Body body, double scale);

/// A body that holds this one, larger by up to `more` [m] on every side.
Body enlarged(Body body, double more);

/// The product's tool made of these bodies.
Tool toolOf(const Bodies& bodies);

/// About the size `scale` [m]: a cylinder, flat ones and needles too; or one to five bodies of any kind, anywhere.
Bodies randomBodies(Random& random, double scale);

}  // namespace sweep_guard_core::soundness
