#pragma once

#include <Eigen/Core>
#include <vector>

namespace sweep_guard_core {

/// A half-space {p : n·p <= d}, in the frame its variable's suffix names (`clip_B` is in box frame B).
/// The unit normal points out of it: signedDistance() is negative inside, zero on the boundary plane.
class HalfSpace {
 public:
  /// @param normal  outward normal, any length above 1e-10 [-]
  /// @param offset  signed distance of the boundary plane from the origin along the unit normal [m]
  /// @throws InvalidInput if `normal` is too short to normalize
  HalfSpace(const Eigen::Vector3d& normal, double offset);

  const Eigen::Vector3d& normal() const { return normal_; }                                   ///< unit, outward [-]
  double offset() const { return offset_; }                                                   ///< [m]
  double signedDistance(const Eigen::Vector3d& p) const { return normal_.dot(p) - offset_; }  ///< [m]

  /// Returns the half-space with its boundary moved outwards by `distance` [m]; inwards if negative.
  HalfSpace grown(double distance) const;

 private:
  Eigen::Vector3d normal_;
  double offset_;
};

/// A convex polygon: its corners in order, in one plane [m]; a corner may repeat. One corner is a point, two are a
/// segment, none is the empty set.
using Polygon = std::vector<Eigen::Vector3d>;

/// Returns the part of a convex polygon that lies in a half-space (Sutherland and Hodgman 1974). The boundary plane
/// belongs to the half-space: of a polygon that only touches it, the touching corners remain. Keeps the order.
Polygon clip(const Polygon& polygon, const HalfSpace& half_space);

/// Returns the faces of the intersection of half-spaces, in the frame of these: one convex polygon [m] for each
/// half-space that bounds it, counter-clockwise seen from outside, in their order. A redundant half-space has no face;
/// if its plane touches the intersection, it may have a face without area. An empty intersection has no faces.
/// @param half_spaces  each once; their intersection must be bounded (not checked). The time grows faster than the
///                     square of their number: at most a few dozen
/// @param radius       the intersection lies within this distance of the origin [m], > 0; not checked
std::vector<Polygon> polytopeFaces(const std::vector<HalfSpace>& half_spaces, double radius);

/// Returns the volume [m^3] of the convex polytope with these faces from polytopeFaces(); 0 if there are none.
double polytopeVolume(const std::vector<Polygon>& faces);

}  // namespace sweep_guard_core
