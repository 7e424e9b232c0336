#include <algorithm>
#include <cmath>

#include "camera/depth_surface.h"

namespace sweep_guard_core {

size_t DepthSurface::seen() const {
  return static_cast<size_t>(
      std::count_if(depths_.begin(), depths_.end(), [](float depth) { return !std::isnan(depth); }));
}

size_t DepthSurface::hidden() const {
  size_t count = 0;
  self_.forEach([&](std::uint32_t u, std::uint32_t v) { count += std::isnan(depths_[v * stride_ + u]) ? 0 : 1; });
  return count;
}

DepthSurface::Expected DepthSurface::compare(const std::vector<float>& depths,
                                             const std::vector<Eigen::Vector3d>& points_F, double distance) const {
  const Eigen::Isometry3d X_CF = X_FC_.inverse();
  Expected expected;
  for (const Eigen::Vector3d& p_F : points_F) {
    const Eigen::Vector3d p_C = X_CF * p_F;
    if (!(p_C.z() > options_.nearest && p_C.z() < options_.farthest)) continue;
    const double u = std::round(camera_.fx * p_C.x() / p_C.z() + camera_.cx);
    const double v = std::round(camera_.fy * p_C.y() / p_C.z() + camera_.cy);
    if (!(u >= 0.0 && u < grid_.width() && v >= 0.0 && v < grid_.height())) continue;
    const auto column = static_cast<std::uint32_t>(u);
    const auto row = static_cast<std::uint32_t>(v);
    const bool found = showsSelf(depths, column, row, std::ceil(camera_.fx * distance / p_C.z()));
    const float depth = depths[size_t{row} * grid_.width() + column];
    if (std::isnan(depth) || (!found && depth <= p_C.z())) continue;
    ++expected.points;
    expected.found += found ? 1 : 0;
  }
  return expected;
}

// At a pixel, or at most as far from it along row and column.
bool DepthSurface::showsSelf(const std::vector<float>& depths, std::uint32_t column, std::uint32_t row,
                             double pixels) const {
  const auto from = [pixels](std::uint32_t at) { return static_cast<std::uint32_t>(std::max(0.0, at - pixels)); };
  const auto to = [pixels](std::uint32_t at, std::uint32_t end) {
    return static_cast<std::uint32_t>(std::min(end - 1.0, at + pixels));
  };
  for (std::uint32_t v = from(row); v <= to(row, grid_.height()); ++v) {
    for (std::uint32_t u = from(column); u <= to(column, grid_.width()); ++u) {
      if (self_.hides(u, v) && depths[size_t{v} * grid_.width() + u] <= static_cast<float>(options_.farthest))
        return true;
    }
  }
  return false;
}

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
