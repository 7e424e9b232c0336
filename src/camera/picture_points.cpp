#include <cmath>

#include "camera/depth_surface.h"

namespace sweep_guard_core {

std::vector<PicturePoint> DepthSurface::points(const std::vector<float>& depths, size_t max_pixels) const {
  const auto pixels = static_cast<double>(depths.size());
  const auto step = static_cast<std::uint32_t>(std::ceil(std::sqrt(pixels / static_cast<double>(max_pixels))));
  std::vector<PicturePoint> points;
  points.reserve(depths.size() / (size_t{step} * step));
  const auto add = [&](std::uint32_t u, std::uint32_t v, double depth, PointKind kind) {
    if (depth <= options_.farthest)
      points.push_back({(X_FC_ * Eigen::Vector3d(depth * x_[u], depth * y_[v], depth)).cast<float>(), kind});
  };
  for (std::uint32_t v = 0; v < grid_.height(); v += step) {
    for (std::uint32_t u = 0; u < grid_.width(); u += step) {
      const bool self = self_.hides(u, v);
      add(u, v, double{nearer_before_[v * stride_ + u]}, self ? PointKind::kRemembered : PointKind::kSeen);
      if (self) add(u, v, double{depths[size_t{v} * grid_.width() + u]}, PointKind::kSelf);
    }
  }
  return points;
}

}  // namespace sweep_guard_core
