#include "interaction/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Without branches, which would be hard to predict.
size_t octantOf(const Eigen::Vector2d& direction) {
  const bool steep = std::abs(direction.y()) > std::abs(direction.x());
  return size_t{direction.y() < 0.0} + 2 * size_t{direction.x() < 0.0} + 4 * size_t{steep};
}

// The direction at which each octant begins, counter-clockwise.
const std::array<Eigen::Vector2d, 8> kOctants = {Eigen::Vector2d(1.0, 0.0),
                                                 {1.0, -1.0},
                                                 {-1.0, 1.0},
                                                 {-1.0, 0.0},
                                                 {1.0, 1.0},
                                                 {0.0, -1.0},
                                                 {0.0, 1.0},
                                                 {-1.0, -1.0}};

}  // namespace

Outline::Outline(const std::vector<Eigen::Vector2d>& corners)
    : squared_inradius_(std::numeric_limits<double>::infinity()) {
  for (const Eigen::Vector2d& p : corners) {
    bounds_.extend(p);
    center_ += p / static_cast<double>(corners.size());
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % corners.size()];
    const Eigen::Vector2d along = (to - from).normalized();
    const Eigen::Vector2d normal(along.y(), -along.x());
    sides_.push_back({to - center_, normal, normal.dot(from)});
    squared_inradius_ = std::min(squared_inradius_, std::pow(sides_.back().beyond(center_), 2));
  }
  for (size_t i = 0; i < kOctants.size(); ++i) {
    size_t& first = first_of_octant_[i];
    while (first + 1 < sides_.size() && !isToward(first, kOctants[i])) ++first;
  }
}

bool Outline::isToward(size_t side, const Eigen::Vector2d& direction) const {
  const Eigen::Vector2d& start = sides_[side == 0 ? sides_.size() - 1 : side - 1].end;
  return cross(start, direction) >= 0.0 && cross(sides_[side].end, direction) < 0.0;
}

bool Outline::hasCorners(const std::vector<Eigen::Vector2d>& corners, double tolerance) const {
  if (corners.size() != sides_.size()) return false;
  return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    const auto lies_in = [&](const Eigen::Vector2d& p) { return std::abs(side.beyond(p)) <= tolerance; };
    return std::count_if(corners.begin(), corners.end(), lies_in) == 2;
  });
}

bool Outline::cut(const std::array<Eigen::Vector3d, 3>& triangle, PolygonCutter& part) const {
  part.begin(triangle);
  if (near(triangle[0]) && near(triangle[1]) && near(triangle[2])) return true;
  const Side* cut_off = nullptr;
  for (const Eigen::Vector3d& corner : triangle) {
    if (near(corner) || (cut_off != nullptr && cut_off->beyond(corner.head<2>()) > 0.0)) continue;
    const size_t side = sideToward(fromCenter(corner));
    if (!(sides_[side].beyond(corner.head<2>()) > 0.0)) continue;
    cutAround(side, part);
    cut_off = &sides_[side];
  }
  return !part.corners().empty();
}

// Returns the side that a ray from the center meets: a point farther out on it is beyond this side.
size_t Outline::sideToward(const Eigen::Vector2d& direction) const {
  size_t side = first_of_octant_[octantOf(direction)];
  while (cross(sides_[side].end, direction) > 0.0) side = side + 1 == sides_.size() ? 0 : side + 1;
  return side;
}

// What a wall cuts ends on its plane, within the wall or beyond one of its neighbors: walls farther on need not be tried
// where a neighbor cuts nothing.
void Outline::cutAround(size_t side, PolygonCutter& part) const {
  const auto cut = [&](size_t i) {
    return part.cut([&wall = sides_[i]](const Eigen::Vector3d& p) { return wall.beyond(p.head<2>()); });
  };
  const size_t count = sides_.size();
  if (!cut(side)) return;
  for (size_t i = (side + 1) % count; i != side && cut(i);) i = (i + 1) % count;
  for (size_t i = (side + count - 1) % count; i != side && cut(i);) i = (i + count - 1) % count;
}

}  // namespace sweep_guard_core
