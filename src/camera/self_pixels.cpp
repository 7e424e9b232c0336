#include "camera/self_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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

void SelfPixels::begin(const Eigen::Isometry3d& X_FC, const std::vector<SweptVolume>& bodies_F) {
  X_FC_ = X_FC;
  bodies_.clear();
  for (const SweptVolume& body_F : bodies_F) {
    const PixelBounds bounds = boundsOf(X_FC.inverse() * body_F.box.X_MB, body_F.box.half_extents);
    bodies_.push_back({body_F, planesOf(body_F), bounds});
  }
  tiles_.assign(grid_.tiles(), 0);
}

void SelfPixels::find(const SeenVertices& seen, size_t tile_row) {
  const size_t first = tile_row * grid_.tileColumns();
  const auto top = static_cast<std::uint32_t>(tile_row * Grid::kTileRows);
  for (const Body& body : bodies_) {
    const PixelBounds& bounds = body.bounds;
    if (bounds.bottom <= top || bounds.top >= top + Grid::kTileRows) continue;
    for (size_t u = bounds.left / Grid::kTileColumns; u * Grid::kTileColumns < bounds.right; ++u)
      addShown(seen, body, first + u);
    const std::uint32_t bottom = std::min(bounds.bottom, top + Grid::kTileRows);
    for (std::uint32_t v = std::max(bounds.top, top); v < bottom; ++v) addCast(seen, body, v);
  }
}

size_t SelfPixels::count() const {
  return std::accumulate(tiles_.begin(), tiles_.end(), size_t{0}, [](size_t sum, std::uint32_t tile) {
    return sum + static_cast<size_t>(__builtin_popcount(tile));
  });
}

void SelfPixels::addShown(const SeenVertices& seen, const Body& body, size_t tile) {
  std::array<std::uint16_t, simd::kBlock> bits;
  withBlock(seen.places_F, tile,
            [&](const float* vertices) { simd::kernels().classifyBlock(vertices, body.planes, bits.data()); });
  for (std::uint32_t i = 0; i < simd::kBlock; ++i) {
    if (bits[i] != simd::kInsideAll) continue;
    const auto [u, v] = grid_.pixel(tile, i);
    if (!std::isnan(seen.depths[v * seen.stride + u])) tiles_[tile] |= std::uint32_t{1} << i;
  }
}

// Between the depths of the body, a ray that comes to it is not beyond one plane.
void SelfPixels::addCast(const SeenVertices& seen, const Body& body, std::uint32_t row) {
  const Eigen::Vector3d& p_FC = X_FC_.translation();
  for (std::uint32_t u = body.bounds.left; u < body.bounds.right; ++u) {
    if (!std::isnan(seen.depths[row * seen.stride + u])) continue;
    const Eigen::Vector3d ray_F =
        X_FC_.linear() * Eigen::Vector3d((u - camera_.cx) / camera_.fx, (row - camera_.cy) / camera_.fy, 1.0);
    if (!mayMeet(body.volume_F, p_FC + body.bounds.nearest * ray_F, p_FC + body.bounds.farthest * ray_F)) continue;
    add(grid_.place(u, row));
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
