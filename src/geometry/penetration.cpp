#include "geometry/penetration.h"

#include <ccd/ccd.h>

#include <algorithm>
#include <optional>

namespace sweep_guard_core {
namespace {

constexpr int kMaxImprovements = 50;
constexpr double kNear = 0.9;  // cosine of the angle to a neighbor's normal

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

// Improves a direction as long as its depth becomes less.
class Descent {
 public:
  Descent(const SupportMapping& tool, const SupportMapping& obstacle, double size, const Eigen::Vector3d& direction)
      : tool_(tool),
        obstacle_(obstacle),
        size_(size),
        best_(direction),
        depth_(depthAlong(direction, tool, obstacle)) {}

  bool attempt(const Eigen::Vector3d& direction, double least = 0.0) {
    const double depth = depthAlong(direction, tool_, obstacle_);
    if (!(depth < depth_ - least)) return false;
    depth_ = depth;
    best_ = direction;
    return true;
  }

  void run(const IsLocalMinimum& is_local_minimum) {
    for (int i = 0; i < kMaxImprovements && !is_local_minimum(best_, depth_); ++i) {
      const Translated moved_out{tool_, (1.01 * depth_ + 1e-6 * size_) * best_};
      if (!attempt(separation(moved_out, obstacle_, /*accuracy=*/1e-10 * size_, best_).normal, 1e-9 * size_)) return;
    }
  }

  const Eigen::Vector3d& best() const { return best_; }

 private:
  const SupportMapping& tool_;
  const SupportMapping& obstacle_;
  double size_;
  Eigen::Vector3d best_;
  double depth_;
};

}  // namespace

double depthAlong(const Eigen::Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle) {
  return normal.dot(obstacle.supportPoint(normal) - tool.supportPoint(-normal));
}

Eigen::Vector3d minimumTranslationDirection(const SupportMapping& tool, const SupportMapping& obstacle,
                                            const Proposals& proposals, const NeighborNormals& neighbors, double size,
                                            const IsLocalMinimum& is_local_minimum) {
  assert(!proposals.empty());
  Descent descent(tool, obstacle, size, neighbors.empty() ? proposals.front() : neighbors.back());
  for (const Eigen::Vector3d& direction : proposals) descent.attempt(direction);
  descent.run(is_local_minimum);
  const auto near = [&](const Eigen::Vector3d& neighbor) { return neighbor.dot(descent.best()) > kNear; };
  if (std::any_of(neighbors.begin(), neighbors.end(), near)) return descent.best();
  if (const auto direction = polytopeDirection(tool, obstacle, size)) {
    Descent other(tool, obstacle, size, *direction);
    other.attempt(-*direction);
    other.run(is_local_minimum);
    descent.attempt(other.best());
  }
  return descent.best();
}

}  // namespace sweep_guard_core
