#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes.h"
#include "soundness/real.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard::soundness {

/// A convex part of a tool, in the tool frame T, told in numbers: what the product's shapes are made from, and all that
/// the checks know of it. Nothing here asks the product.
struct Body {
  enum class Kind { kCylinder };
  Kind kind = Kind::kCylinder;
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< fills z in [-length, 0] [m]
  int sides = 12;       ///< of the polygon that stands for it in statistics
};

using Bodies = std::vector<Body>;

/// Whether some points of the body have all points within `inset` [m] of them in the body, too.
bool hasInset(const Body& body, Real inset);

/// Of the points that lie at least `inset` [m] deep in the body, one that is farthest along a direction of any length.
Vector3r support(const Body& body, const Vector3r& direction_T, Real inset = 0);

/// How deep a point lies in the body [m]; negative: it is outside, at least so far away.
Real depth(const Body& body, const Vector3r& p_T);

/// The point of the body that is nearest to a point.
Vector3r nearest(const Body& body, const Vector3r& p_T);

/// Largest distance of a point of the bodies from the origin of T [m].
double extentOf(const Bodies& bodies);

/// The body with all lengths times a power of two.
Body scaled(Body body, double scale);

/// A body that holds this one, larger by up to `more` [m] on every side.
Body enlarged(Body body, double more);

/// The product's tool made of these bodies.
Tool toolOf(const Bodies& bodies);

/// About the size `scale` [m]: plain, flat ones and needles.
Bodies randomBodies(Random& random, double scale);

}  // namespace sweep_guard::soundness
