#include "camera/self_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sweep_guard_core {
namespace {

simd::Planes planesOf(const SweptVolume& volume_F) {
  const Eigen::Isometry3d& X_FB = volume_F.box.X_MB;
  simd::Planes planes;
  volume_F.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    const Eigen::Vector3d normal_F = X_FB.linear() * normal_B;
    const size_t i = planes.count++;
    for (size_t axis = 0; axis < 3; ++axis)
      planes.normal[axis][i] = static_cast<float>(normal_F[static_cast<Eigen::Index>(axis)]);
    planes.outside[i] = planes.inside[i] = static_cast<float>(normal_F.dot(X_FB.translation()) + offset);
  });
  return planes;
}

// Returns whether no plane of a convex volume has a segment wholly beyond it.
bool mayMeet(const SweptVolume& body_F, const Eigen::Vector3d& from_F, const Eigen::Vector3d& to_F) {
  const Eigen::Isometry3d X_BF = body_F.box.X_MB.inverse();
  const Eigen::Vector3d from_B = X_BF * from_F;
  const Eigen::Vector3d to_B = X_BF * to_F;
  bool beyond = false;
  body_F.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    beyond = beyond || (normal_B.dot(from_B) > offset && normal_B.dot(to_B) > offset);
  });
  return !beyond;
}

}  // namespace

void SelfPixels::find(const SeenVertices& seen, const Eigen::Isometry3d& X_FC,
                      const std::vector<SweptVolume>& bodies_F) {
  blocks_.measure(seen.places_F);
  tiles_.assign(blocks_.count(), 0);
  beyond_.resize(simd::padded(blocks_.count()));
  for (const SweptVolume& body_F : bodies_F) {
    addShown(seen, planesOf(body_F));
    addCast(seen, X_FC, body_F);
  }
  count_ = 0;
  for (const std::uint32_t tile : tiles_) count_ += static_cast<size_t>(__builtin_popcount(tile));
}

void SelfPixels::addShown(const SeenVertices& seen, const simd::Planes& planes) {
  simd::kernels().classifyBoxes(blocks_.arrays(), blocks_.count(), planes, beyond_.data());
  std::array<std::uint16_t, simd::kBlock> bits;
  for (size_t tile = 0; tile < blocks_.count(); ++tile) {
    if (beyond_[tile] != 0) continue;
    withBlock(seen.places_F, tile,
              [&](const float* vertices) { simd::kernels().classifyBlock(vertices, planes, bits.data()); });
    for (std::uint32_t i = 0; i < simd::kBlock; ++i) {
      if (bits[i] != simd::kInsideAll) continue;
      const auto [u, v] = grid_.pixel(tile, i);
      if (!std::isnan(seen.depths[v * seen.stride + u])) tiles_[tile] |= std::uint32_t{1} << i;
    }
  }
}

// Between the depths of the body, a ray that comes to it is not beyond one plane.
void SelfPixels::addCast(const SeenVertices& seen, const Eigen::Isometry3d& X_FC, const SweptVolume& body_F) {
  const Eigen::Vector3d& p_FC = X_FC.translation();
  const PixelBounds bounds = boundsOf(X_FC.inverse() * body_F.box.X_MB, body_F.box.half_extents);
  for (std::uint32_t v = bounds.top; v < bounds.bottom; ++v) {
    for (std::uint32_t u = bounds.left; u < bounds.right; ++u) {
      if (!std::isnan(seen.depths[v * seen.stride + u])) continue;
      const Eigen::Vector3d ray_F =
          X_FC.linear() * Eigen::Vector3d((u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1.0);
      if (!mayMeet(body_F, p_FC + bounds.nearest * ray_F, p_FC + bounds.farthest * ray_F)) continue;
      add(grid_.place(u, v));
    }
  }
}

// Returns the pixels and depths in which a body may be.
SelfPixels::PixelBounds SelfPixels::boundsOf(const Eigen::Isometry3d& X_CB, const Eigen::Vector3d& half_extents) const {
  Eigen::AlignedBox3d bounds_C;
  Eigen::AlignedBox2d picture;
  const auto limits = [](double low, double high, std::uint32_t size) {
    const auto clamped = [size](double at) {
      return static_cast<std::uint32_t>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return std::pair(clamped(std::floor(low)), clamped(std::ceil(high) + 1.0));
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sides((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                                (corner & 4) != 0 ? 1.0 : -1.0);
    const Eigen::Vector3d p_C = X_CB * sides.cwiseProduct(half_extents);
    bounds_C.extend(p_C);
    const double z = std::max(p_C.z(), 1e-6);
    picture.extend(Eigen::Vector2d(camera_.fx * p_C.x() / z + camera_.cx, camera_.fy * p_C.y() / z + camera_.cy));
  }
  if (bounds_C.max().z() <= 0.0) return {};
  const bool around = bounds_C.min().z() <= 1e-3;
  const auto [left, right] =
      around ? std::pair(0U, grid_.width()) : limits(picture.min().x(), picture.max().x(), grid_.width());
  const auto [top, bottom] =
      around ? std::pair(0U, grid_.height()) : limits(picture.min().y(), picture.max().y(), grid_.height());
  return {left, right, top, bottom, std::max(0.0, bounds_C.min().z()), bounds_C.max().z()};
}

}  // namespace sweep_guard_core
