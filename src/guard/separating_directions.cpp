#include "guard/separating_directions.h"

#include <algorithm>

#include "common/floating_point.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kSameDirection = 0.9999;  // cosine of the angle to a direction that serves as well
constexpr double kPoseRounding = 1e-14;    // of distances from the origin of M

Eigen::Vector3d normalAt(const simd::Directions& directions, std::size_t i) {
  return {directions.normal[0][i], directions.normal[1][i], directions.normal[2][i]};
}

}  // namespace

void SeparatingDirections::begin(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, double margin) {
  shape_T_ = &shape_T;
  sub_motions_ = &sub_motions;
  margin_ = margin;
  for (const Motion& motion : sub_motions) {
    const double arc = chordError(shape_T.radiusAbout(motion.axis_T()), motion.angle());
    margin_ = std::max(margin_, margin + motion.deviation_bound + arc);
  }
  origin_M_ = sub_motions.front().X_MT_start.translation();
  const double travel = (sub_motions.back().X_MT_end.translation() - origin_M_).norm();
  rounding_of_poses_ = kDistanceRounding * shape_T.boundingRadius() + kPoseRounding * (origin_M_.norm() + travel);
  for (std::size_t i = 0; i < directions_.count; ++i) set(i, normalAt(directions_, i));
}

void SeparatingDirections::add(const Eigen::Vector3d& direction_M) {
  for (std::size_t i = 0; i < directions_.count; ++i) {
    if (normalAt(directions_, i).dot(direction_M) > kSameDirection) return;
  }
  const bool full = directions_.count == simd::kMaxDirections;
  const std::size_t place = full ? oldest_ : directions_.count++;
  if (full) oldest_ = (oldest_ + 1) % simd::kMaxDirections;
  set(place, direction_M);
}

void SeparatingDirections::set(std::size_t i, const Eigen::Vector3d& direction_M) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    directions_.normal[axis][i] = direction_M[static_cast<Eigen::Index>(axis)];
  }
  directions_.least[i] = leastAlong(direction_M);
}

// Returns a lower bound of direction * q for every point q of the piece, grown by the margin, at any time.
double SeparatingDirections::leastAlong(const Eigen::Vector3d& direction_M) const {
  double least = kInfinity;
  for (const Motion& motion : *sub_motions_) {
    const auto at = [&](const Eigen::Isometry3d& X_MT) {
      return direction_M.dot(X_MT.translation() - origin_M_) -
             shape_T_->support(X_MT.linear().transpose() * -direction_M);
    };
    least = std::min({least, at(motion.X_MT_start), at(motion.X_MT_end)});
  }
  return least - margin_;
}

void SeparatingDirections::load(std::size_t place, const MovingTriangle& triangle_M, bool moved) {
  batch_.corners = moved ? 6 : 3;
  double farthest = 0.0;
  for (std::size_t corner = 0; corner < batch_.corners; ++corner) {
    const Eigen::Vector3d& p_M = corner < 3 ? triangle_M.start_M[corner] : triangle_M.end_M[corner - 3];
    const Eigen::Vector3d p = p_M - origin_M_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      batch_.position[corner][axis][place] = p[static_cast<Eigen::Index>(axis)];
    }
    farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  }
  rounding_[place] = rounding_of_poses_ + kDistanceRounding * farthest;
}

void SeparatingDirections::separate() { simd::kernels().separate(batch_, directions_, gaps_); }

Eigen::Vector3d SeparatingDirections::best_M(std::size_t place) const {
  if (directions_.count == 0) return Eigen::Vector3d::Zero();
  return normalAt(directions_, static_cast<std::size_t>(gaps_.direction[place]));
}

}  // namespace sweep_guard_core
