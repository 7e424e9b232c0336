#pragma once

#include <ccd/ccd.h>

#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// Tells by libccd's GJK whether two convex bodies overlap: an oracle that shares no code with separation().
inline bool overlapByLibccd(const SupportMapping& a, const SupportMapping& b) {
  const auto support_of = [](const void* body, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const Eigen::Vector3d along(direction->v[0], direction->v[1], direction->v[2]);
    const Eigen::Vector3d p = static_cast<const SupportMapping*>(body)->supportPoint(along.normalized());
    ccdVec3Set(point, p.x(), p.y(), p.z());
  };
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support_of;
  ccd.support2 = support_of;
  ccd.max_iterations = 500;
  return ccdGJKIntersect(&a, &b, &ccd) != 0;
}

}  // namespace sweep_guard_core
