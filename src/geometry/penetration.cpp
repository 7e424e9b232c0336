#include "geometry/penetration.h"

#include <ccd/ccd.h>

#include <cmath>
#include <optional>

namespace sweep_guard_core {
namespace {

constexpr int kMaxImprovements = 50;

// libccd's tolerances are lengths: its bodies must have about unit size.
struct UnitBody {
  const SupportMapping& body;
  double size;
};

void unitSupport(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& [body, size] = *static_cast<const UnitBody*>(object);
  const Eigen::Vector3d along(direction->v[0], direction->v[1], direction->v[2]);
  const double length = along.norm();
  const Eigen::Vector3d p =
      body.supportPoint(length > 0.0 ? Eigen::Vector3d(along / length) : Eigen::Vector3d::UnitZ()) / size;
  ccdVec3Set(point, p.x(), p.y(), p.z());
}

std::optional<Eigen::Vector3d> polytopeDirection(const SupportMapping& tool, const SupportMapping& obstacle,
                                                 double size) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = unitSupport;
  ccd.support2 = unitSupport;
  ccd.max_iterations = 100;
  ccd.epa_tolerance = 1e-3;
  const UnitBody first{tool, size};
  const UnitBody second{obstacle, size};
  ccd_real_t depth = 0.0;
  ccd_vec3_t direction;
  ccd_vec3_t position;
  if (ccdGJKPenetration(&first, &second, &ccd, &depth, &direction, &position) != 0) return std::nullopt;
  const Eigen::Vector3d out(direction.v[0], direction.v[1], direction.v[2]);
  const double length = out.norm();
  if (!(length > 0.5 && length < 2.0)) return std::nullopt;
  return Eigen::Vector3d(-out / length);
}

struct Translated {
  const SupportMapping& body;
  Eigen::Vector3d translation;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return body.supportPoint(direction) + translation;
  }
};

}  // namespace

double depthAlong(const Eigen::Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle) {
  return normal.dot(obstacle.supportPoint(normal) - tool.supportPoint(-normal));
}

Eigen::Vector3d minimumTranslationDirection(const SupportMapping& tool, const SupportMapping& obstacle,
                                            const Proposals& proposals, double size) {
  assert(!proposals.empty());
  Eigen::Vector3d best = proposals.front();
  double depth = depthAlong(best, tool, obstacle);
  const auto improves = [&](const Eigen::Vector3d& direction, double least) {
    const double new_depth = depthAlong(direction, tool, obstacle);
    if (!(new_depth < depth - least)) return false;
    depth = new_depth;
    best = direction;
    return true;
  };
  for (const Eigen::Vector3d& direction : proposals) improves(direction, 0.0);
  if (const auto direction = polytopeDirection(tool, obstacle, size)) {
    if (!improves(*direction, 0.0)) improves(-*direction, 0.0);
  }
  for (int i = 0; i < kMaxImprovements; ++i) {
    const Translated moved_out{tool, (1.01 * depth + 1e-6 * size) * best};
    if (!improves(separation(moved_out, obstacle, /*accuracy=*/0.0, best).normal, 1e-9 * size)) break;
  }
  return best;
}

}  // namespace sweep_guard_core
