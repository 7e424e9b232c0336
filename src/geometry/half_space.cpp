#include "sweep_guard/geometry/half_space.h"

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

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

}  // namespace sweep_guard_core
