#include "scene/welding.h"

#include <array>
#include <map>
#include <string>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

using Corners = std::vector<Eigen::Vector3d>;

namespace {

void checkCorners(const Corners& corners) {
  if (corners.size() % 3 != 0) {
    throw InvalidInput("triangles have " + std::to_string(corners.size()) + " corners: send three for each");
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    if (!corners[i].allFinite()) throw InvalidInput("corner " + std::to_string(i) + " of the triangles is not finite");
  }
}

}  // namespace

TriangleSurface Welding::weld(const Corners& corners) {
  if (!agreesWith(corners)) search(corners);
  TriangleSurface surface{{}, triangles_};
  surface.vertices.reserve(first_corners_.size());
  for (const std::uint32_t corner : first_corners_) surface.vertices.push_back(corners[corner]);
  return surface;
}

// The difference of two infinite coordinates is not 0, so that search() refuses them.
bool Welding::agreesWith(const Corners& corners) const {
  if (corners.size() != 3 * triangles_.size()) return false;
  auto corner = corners.begin();
  for (const Triangle& triangle : triangles_) {
    for (const std::uint32_t vertex : triangle) {
      if (*corner++ - corners[first_corners_[vertex]] != Eigen::Vector3d::Zero()) return false;
    }
  }
  return true;
}

void Welding::search(const Corners& corners) {
  checkCorners(corners);
  std::map<std::array<double, 3>, std::uint32_t> vertices;
  std::vector<Triangle> triangles(corners.size() / 3);
  std::vector<std::uint32_t> first_corners;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& p = corners[i];
    const auto next = static_cast<std::uint32_t>(first_corners.size());
    const auto [vertex, is_new] = vertices.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new) first_corners.push_back(i);
    triangles[i / 3][i % 3] = vertex->second;
  }
  triangles_ = std::move(triangles);
  first_corners_ = std::move(first_corners);
}

}  // namespace sweep_guard_core
