#include "sweep_guard/motion/plane_cover.h"

#include <algorithm>
#include <numeric>

namespace sweep_guard_core {
namespace {

constexpr double kSlack = 0.05;  // by how much of its gap a plane may move to the tool

using Corners = std::array<Eigen::Vector3d, 3>;

double farthest(const Corners& vectors, const Eigen::Vector3d& direction) {
  return std::max({direction.dot(vectors[0]), direction.dot(vectors[1]), direction.dot(vectors[2])});
}

double fastest(const Corners& velocities) {
  return std::max({velocities[0].norm(), velocities[1].norm(), velocities[2].norm()});
}

class Cover {
 public:
  Cover(const UncoveredSurfaces& beyond, size_t max_planes) : max_planes_(max_planes) { cover_.uncovered = beyond; }

  void add(size_t index, const NearTriangle& triangle) {
    for (size_t i = 0; i < cover_.planes.size(); ++i) {
      if (moveBefore(cover_.planes[i], slacks_[i], triangle)) return;
    }
    if (cover_.planes.size() < max_planes_) return addPlane(index, triangle);
    cover_.uncovered.distance = std::min(cover_.uncovered.distance, triangle.gap);
    cover_.uncovered.speed = std::max(cover_.uncovered.speed, fastest(triangle.velocities_W));
  }

  PlaneCover cover_;

 private:
  void addPlane(size_t index, const NearTriangle& triangle) {
    const Eigen::Vector3d& n = triangle.normal_W;
    const auto& corners = triangle.corners_W;
    const Eigen::Vector3d& highest = *std::max_element(
        corners.begin(), corners.end(), [&](const auto& a, const auto& b) { return n.dot(a) < n.dot(b); });
    cover_.planes.push_back({triangle.piece, n, highest, triangle.gap, farthest(triangle.velocities_W, n)});
    cover_.triangles.push_back(index);
    slacks_.push_back(kSlack * std::max(0.0, triangle.gap));
  }

  // Returns whether the triangle lies behind the plane, which may have to move by less than its slack.
  static bool moveBefore(SeparatingPlane& plane, double& slack, const NearTriangle& triangle) {
    if (plane.piece != triangle.piece) return false;
    const double out = farthest(triangle.corners_W, plane.normal_W) - plane.normal_W.dot(plane.point_W);
    if (out > slack) return false;
    const double step = std::max(0.0, out);
    slack -= step;
    plane.gap -= step;
    plane.point_W += step * plane.normal_W;
    plane.surface_speed = std::max(plane.surface_speed, farthest(triangle.velocities_W, plane.normal_W));
    return true;
  }

  size_t max_planes_;
  std::vector<double> slacks_;
};

}  // namespace

PlaneCover coverByPlanes(const std::vector<NearTriangle>& triangles, const UncoveredSurfaces& beyond,
                         size_t max_planes) {
  std::vector<size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) { return triangles[i].gap < triangles[j].gap; });
  Cover cover(beyond, max_planes);
  for (const size_t index : order) cover.add(index, triangles[index]);
  return std::move(cover.cover_);
}

}  // namespace sweep_guard_core
