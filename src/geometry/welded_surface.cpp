#include "geometry/welded_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "geometry/weld.h"
#include "sweep_guard/geometry/enclosure.h"

namespace sweep_guard_core {
namespace {

void replaceCorners(WeldedSurface& surface, const std::vector<std::uint32_t>& first) {
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    for (std::uint32_t& corner : surface.triangles[i]) corner = first[corner];
    if (isDegenerate(surface.triangles[i])) surface.left_out[i] = true;
  }
}

std::uint32_t third(const Triangle& triangle, const EdgeGroups::Group& edge) {
  return triangle[0] ^ triangle[1] ^ triangle[2] ^ edge.low ^ edge.first->high;
}

// Leaves out the later ones of triangles with the same corners. Each is looked for at its edge with the lowest vertices.
bool leaveOutDoubles(WeldedSurface& surface, const EdgeGroups& edges) {
  bool any = false;
  std::vector<std::pair<std::uint32_t, HalfEdge>> by_third;
  edges.forEach([&](const EdgeGroups::Group& group) {
    if (group.size() < 2) return;
    by_third.clear();
    for (const HalfEdge& edge : group) {
      const std::uint32_t corner = third(surface.triangles[edge.triangle()], group);
      if (corner > edge.high) by_third.emplace_back(corner, edge);
    }
    if (by_third.size() < 2) return;
    std::stable_sort(by_third.begin(), by_third.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 1, kept = 0; i < by_third.size(); ++i) {
      if (by_third[i].first != by_third[kept].first) {
        kept = i;
        continue;
      }
      any = true;
      const HalfEdge& edge = by_third[kept].second;
      surface.left_out[by_third[i].second.triangle()] = true;
      if (by_third[i].second.upwards() != edge.upwards()) surface.both_ways[edge.triangle()] = true;
    }
  });
  return any;
}

void sortOut(std::vector<std::uint32_t>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

std::vector<std::uint32_t> verticesAtBorders(const EdgeGroups& edges) {
  std::vector<std::uint32_t> vertices;
  edges.forEach([&](const EdgeGroups::Group& group) {
    if (group.size() == 1) vertices.insert(vertices.end(), {group.low, group.first->high});
  });
  sortOut(vertices);
  return vertices;
}

bool branches(const EdgeGroups& edges) {
  bool found = false;
  edges.forEach([&](const EdgeGroups::Group& group) { found = found || group.size() > 2; });
  return found;
}

EdgeGroups edgesWithoutDoubles(WeldedSurface& surface, const std::vector<std::uint32_t>& first) {
  replaceCorners(surface, first);
  EdgeGroups edges = surface.edges();
  if (leaveOutDoubles(surface, edges)) edges = surface.edges();
  return edges;
}

}  // namespace

double WeldedSurface::diagonal() const {
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = 0; i < vertexCount(); ++i) box.extend(at(i));
  return box.sizes().norm();
}

// Corners that are not exactly at one place are searched for at borders first. Where some are found, or the surface branches,
// it may be doubled: then everywhere.
EdgeGroups WeldedSurface::weld() {
  std::vector<std::uint32_t> first = firstAtPositions(positions);
  EdgeGroups edges = edgesWithoutDoubles(*this, first);
  const double distance = Enclosure::kWeld * diagonal();
  const std::vector<std::uint32_t> at_borders = verticesAtBorders(edges);
  const bool welded = weldNear(positions, at_borders, distance, first);
  if (welded) edges = edgesWithoutDoubles(*this, first);
  if (!welded && !branches(edges)) return edges;
  std::vector<std::uint32_t> all = first;
  sortOut(all);
  if (weldNear(positions, all, distance, first)) edges = edgesWithoutDoubles(*this, first);
  return edges;
}

}  // namespace sweep_guard_core
