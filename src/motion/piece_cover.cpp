#include "motion/piece_cover.h"

#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr double kFloatError = 0x1p-20;  // as that of floatPlanes()

double outside(const Eigen::Vector3d& center_B, const Eigen::Vector3d& half_B) {
  return (center_B.cwiseAbs() - half_B).cwiseMax(0.0).norm();
}

// Planes turned around: what lies wholly beyond them lies behind the plane, whatever the rounding.
void addTurned(const Eigen::Vector3d& normal, double offset, double radius, simd::Planes& planes) {
  const size_t i = planes.count++;
  for (size_t axis = 0; axis < 3; ++axis) {
    planes.normal[axis][i] = static_cast<float>(-normal[static_cast<Eigen::Index>(axis)]);
  }
  const double doubt = kFloatError * (radius + std::abs(offset));
  planes.outside[i] = static_cast<float>(doubt - offset);
  planes.inside[i] = static_cast<float>(-doubt - offset);
}

}  // namespace

void PieceCover::begin(const ConvexShape& shape_T, const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT) {
  shape_T_ = &shape_T;
  mesh_M_ = &mesh_M;
  X_MT_ = X_MT;
  planes_.clear();
  nearest_.reset();
  const Eigen::Matrix3d& R_TB = shape_T.axes_T();
  Eigen::Vector3d middle_B;
  for (int axis = 0; axis < 3; ++axis) {
    const double upper = shape_T.support(R_TB.col(axis));
    const double lower = -shape_T.support(-R_TB.col(axis));
    middle_B[axis] = 0.5 * (upper + lower);
    half_B_[axis] = 0.5 * (upper - lower);
  }
  Eigen::Isometry3d X_TB = Eigen::Isometry3d::Identity();
  X_TB.linear() = R_TB;
  X_TB.translation() = R_TB * middle_B;
  X_BM_ = (X_MT * X_TB).inverse();
  absolute_BM_ = X_BM_.linear().cwiseAbs();
}

double PieceCover::distance(const CenteredBox& box) const {
  return outside(X_BM_ * box.center, half_B_ + absolute_BM_ * box.half);
}

double PieceCover::distance(const Corners& corners) const {
  Eigen::AlignedBox3d box_B;
  for (const Eigen::Vector3d& corner : corners) box_B.extend(X_BM_ * corner);
  return outside(box_B.center(), half_B_ + 0.5 * box_B.sizes());
}

PieceCover::Corners PieceCover::corners_T(const Corners& corners) const {
  const auto corner_T = [&](const Eigen::Vector3d& corner) -> Eigen::Vector3d {
    return X_MT_.linear().transpose() * (corner - X_MT_.translation());
  };
  return {corner_T(corners[0]), corner_T(corners[1]), corner_T(corners[2])};
}

void PieceCover::add(const Eigen::Vector3d& normal_T, double offset_T, size_t number) {
  const Eigen::Vector3d n_M = normal_M(normal_T);
  planes_.push_back({n_M, offset_T + n_M.dot(X_MT_.translation()), number});
}

PieceCover::Corners PieceCover::corners(const Triangle& triangle) const {
  return {mesh_M_->offset(triangle[0]), mesh_M_->offset(triangle[1]), mesh_M_->offset(triangle[2])};
}

std::optional<size_t> PieceCover::behind(const CenteredBox& box) const {
  for (const Plane& plane : planes_) {
    if (plane.stands(box)) return plane.number;
  }
  return std::nullopt;
}

std::optional<size_t> PieceCover::behind(const Corners& corners, size_t begin) const {
  for (size_t i = begin; i < planes_.size(); ++i) {
    if (planes_[i].stands(corners)) return planes_[i].number;
  }
  return std::nullopt;
}

void PieceCover::setNearest(const std::optional<Eigen::Vector3d>& normal_T, double offset_T) {
  nearest_.reset();
  if (!normal_T) return;
  const Eigen::Vector3d n_M = normal_M(*normal_T);
  nearest_ = Plane{n_M, offset_T + n_M.dot(X_MT_.translation()), 0};
}

// Returns how many planes, from the first, are selected or do not stand for any triangle in the box.
size_t PieceCover::selectPlanes(const CenteredBox& box, simd::Planes& planes, PlaneNumbers& selected) const {
  for (size_t i = 0; i < planes_.size(); ++i) {
    if (!planes_[i].mayStand(box)) continue;
    if (planes.count == simd::kMaxPlanes - 1) return i;  // one is left for the nearest
    selected.push_back(planes_[i].number);
    addTurned(planes_[i].normal_M, planes_[i].offset, mesh_M_->radius(), planes);
  }
  return planes_.size();
}

PieceCover::Classified PieceCover::classify(const Cluster& cluster, const CenteredBox& box) const {
  simd::Planes planes;
  PlaneNumbers selected;
  Classified classified{mesh_M_->existing(cluster), 0, {}, selectPlanes(box, planes, selected)};
  const unsigned covering = (1U << planes.count) - 1U;
  if (nearest_ && nearest_->mayStand(box)) {
    addTurned(nearest_->normal_M, nearest_->offset, mesh_M_->radius(), planes);
  }
  if (planes.count == 0) return classified;
  std::array<std::uint16_t, simd::kClusterBlocks * simd::kBlock> bits;
  for (size_t i = 0; i < simd::kClusterBlocks; ++i) {
    withBlock(mesh_M_->places(), cluster.blocks[i],
              [&](const float* vertices) { simd::kernels().classifyBlock(vertices, planes, &bits[i * simd::kBlock]); });
  }
  const auto of = [&](size_t i) -> const std::uint16_t* { return &bits[i * simd::kBlock]; };
  const simd::ClusterCorners& corners = mesh_M_->order().corners[cluster.number];
  classified.nearer &= simd::kernels().classifyTriangles(corners, {of(0), of(1), of(2), of(3)}).not_beyond;
  unsigned standing = 0;
  for (std::uint64_t left = mesh_M_->existing(cluster) & ~classified.nearer; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(__builtin_ctzll(left));
    const auto& [a, b, c] = corners;
    const unsigned behind = bits[a[i]] & bits[b[i]] & bits[c[i]] & covering;
    if (behind == 0) classified.not_nearer |= std::uint64_t{1} << i;
    if ((behind & standing) == 0) standing |= behind & (0U - behind);
  }
  for (size_t i = 0; i < selected.size(); ++i) {
    if ((standing >> i & 1U) != 0) classified.standing.push_back(selected[i]);
  }
  return classified;
}

}  // namespace sweep_guard_core
