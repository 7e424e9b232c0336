#include "sweep_guard/geometry/half_space.h"

#include <Eigen/Geometry>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

Polygon squareOnPlane(const HalfSpace& plane, double half_side) {
  const Eigen::Vector3d center = plane.normal() * plane.offset();
  const Eigen::Vector3d u = plane.normal().unitOrthogonal() * half_side;
  const Eigen::Vector3d v = plane.normal().cross(u);
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

}  // namespace

HalfSpace::HalfSpace(const Eigen::Vector3d& normal, double offset) : normal_(normal.normalized()), offset_(offset) {
  if (!(normal.norm() > 1e-10)) throw InvalidInput("half-space: the normal is too short to give a direction");
}

HalfSpace HalfSpace::grown(double distance) const {
  HalfSpace grown = *this;
  grown.offset_ += distance;
  return grown;
}

Polygon clip(const Polygon& polygon, const HalfSpace& half_space) {
  Polygon inside;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& p = polygon[i];
    const Eigen::Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double distance_p = half_space.signedDistance(p);
    const double distance_q = half_space.signedDistance(q);
    if (distance_p <= 0.0) inside.push_back(p);
    if ((distance_p < 0.0 && distance_q > 0.0) || (distance_p > 0.0 && distance_q < 0.0)) {
      inside.push_back(p + distance_p / (distance_p - distance_q) * (q - p));
    }
  }
  return inside;
}

std::vector<Polygon> polytopeFaces(const std::vector<HalfSpace>& half_spaces, double radius) {
  std::vector<Polygon> faces;
  for (size_t i = 0; i < half_spaces.size(); ++i) {
    Polygon face = squareOnPlane(half_spaces[i], 2.0 * radius);
    for (size_t j = 0; j < half_spaces.size(); ++j) {
      if (j != i) face = clip(face, half_spaces[j]);
    }
    if (face.size() >= 3) faces.push_back(std::move(face));
  }
  return faces;
}

double polytopeVolume(const std::vector<Polygon>& faces) {
  double six_volumes = 0.0;
  for (const Polygon& face : faces) {
    for (size_t i = 2; i < face.size(); ++i) six_volumes += face[0].dot(face[i - 1].cross(face[i]));
  }
  return six_volumes / 6.0;
}

}  // namespace sweep_guard_core
