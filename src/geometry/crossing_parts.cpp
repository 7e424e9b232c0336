#include "geometry/crossing_parts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

#include "common/heartbeat.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxVisits = 50'000'000;  // of triangles and pairs: half a second
constexpr size_t kFew = 64;                // triangles, of which each pair is looked at
constexpr int kMaxDepth = 40;

using Corners = std::array<Eigen::Vector3d, 3>;
using Numbers = std::vector<std::uint32_t>;

// Within the triangle or on its border.
bool holds(const Corners& face, const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  for (size_t i = 0; i < 3; ++i) {
    if (normal.dot((face[(i + 1) % 3] - face[i]).cross(point - face[i])) < 0.0) return false;
  }
  return true;
}

bool passesThrough(const Corners& edges, const Corners& face) {
  const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]).stableNormalized();
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& from = edges[i];
    const Eigen::Vector3d& to = edges[(i + 1) % 3];
    const double before = normal.dot(from - face[0]);
    const double after = normal.dot(to - face[0]);
    if ((before < 0.0) == (after < 0.0)) continue;
    if (holds(face, normal, from + before / (before - after) * (to - from))) return true;
  }
  return false;
}

class CrossingSearch {
 public:
  CrossingSearch(const std::vector<Triangle>& triangles, const Numbers& parts, const WeldedSurface& surface,
                 double least)
      : triangles_(triangles), parts_(parts), surface_(surface) {
    findShrunk(least);
  }

  std::optional<bool> run() {
    Numbers all(triangles_.size());
    std::iota(all.begin(), all.end(), 0U);
    Eigen::AlignedBox3d box;
    for (const std::uint32_t i : all) box.extend(boxOf(i));
    const bool found = findIn(box, all, kMaxDepth);
    return visits_ > kMaxVisits ? std::nullopt : std::optional(found);
  }

 private:
  Corners cornersOf(std::uint32_t i) const {
    const auto& [a, b, c] = triangles_[i];
    return {surface_.at(a), surface_.at(b), surface_.at(c)};
  }
  // Moves the corners of each part into the solid, against the mean normal of its triangles there.
  void findShrunk(double least) {
    shrunk_.resize(triangles_.size());
    std::unordered_map<std::uint32_t, Eigen::Vector3f> normals;  // of one part, by vertex
    for (size_t begin = 0, end = 0; begin < triangles_.size(); begin = end) {
      normals.clear();
      for (; end < triangles_.size() && parts_[end] == parts_[begin]; ++end) {
        const Corners corners = cornersOf(static_cast<std::uint32_t>(end));
        const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
        for (const std::uint32_t vertex : triangles_[end])
          normals.try_emplace(vertex, Eigen::Vector3f::Zero()).first->second += normal.cast<float>();
      }
      for (size_t i = begin; i < end; ++i) {
        for (size_t k = 0; k < 3; ++k)
          shrunk_[i][k] = -static_cast<float>(least) * normals.at(triangles_[i][k]).stableNormalized();
      }
    }
  }

  Corners shrunk(std::uint32_t i) const {
    Corners corners = cornersOf(i);
    for (size_t k = 0; k < 3; ++k) corners[k] += shrunk_[i][k].cast<double>();
    return corners;
  }

  Eigen::AlignedBox3d boxOf(std::uint32_t i) const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : cornersOf(i)) box.extend(corner);
    return box;
  }

  // Also true if it gives up.
  bool findIn(const Eigen::AlignedBox3d& box, const Numbers& inside, int depth) {
    const auto is_other = [&](std::uint32_t i) { return parts_[i] != parts_[inside.front()]; };
    if (std::none_of(inside.begin(), inside.end(), is_other)) return false;
    if (inside.size() <= kFew || depth == 0) return anyPair(inside);
    beat();
    visits_ += 2 * inside.size();
    if (visits_ > kMaxVisits) return true;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    for (const bool upper : {false, true}) {
      Eigen::AlignedBox3d half = box;
      (upper ? half.min() : half.max())[axis] = box.center()[axis];
      if (findIn(half, trianglesIn(half, inside), depth - 1)) return true;
    }
    return false;
  }

  Numbers trianglesIn(const Eigen::AlignedBox3d& box, const Numbers& of) const {
    Numbers inside;
    std::copy_if(of.begin(), of.end(), std::back_inserter(inside),
                 [&](std::uint32_t i) { return boxOf(i).intersects(box); });
    return inside;
  }

  bool anyPair(const Numbers& inside) {
    visits_ += inside.size() * inside.size() / 2;
    if (visits_ > kMaxVisits) return true;
    for (size_t i = 1; i < inside.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        if (parts_[inside[i]] != parts_[inside[k]] && cross(inside[i], inside[k])) return true;
      }
    }
    return false;
  }

  bool cross(std::uint32_t i, std::uint32_t k) const {
    if (!boxOf(i).intersects(boxOf(k))) return false;
    return passesThrough(shrunk(i), cornersOf(k)) || passesThrough(shrunk(k), cornersOf(i));
  }

  const std::vector<Triangle>& triangles_;
  const Numbers& parts_;  // of each triangle
  const WeldedSurface& surface_;
  std::vector<std::array<Eigen::Vector3f, 3>> shrunk_;  // by how much each corner is [m]
  size_t visits_ = 0;
};

}  // namespace

std::optional<bool> partsCross(const std::vector<Triangle>& triangles, const Numbers& parts,
                               const WeldedSurface& surface, double least) {
  return CrossingSearch(triangles, parts, surface, least).run();
}

}  // namespace sweep_guard_core
