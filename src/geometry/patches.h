#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/edge_groups.h"

namespace sweep_guard_core {

/// Sorts triangles into patches: two belong to one patch if no third one shares their edge, or through a chain of such
/// neighbors. The triangles of a patch are turned into one direction, that of its first triangle. A patch that cannot
/// be, as a Moebius strip, has borders where directions clash.
class Patches {
 public:
  /// @param edges  of triangles that are not left out; must live as long as this
  Patches(const EdgeGroups& edges, const std::vector<bool>& left_out);

  std::uint32_t count() const { return count_; }
  std::uint32_t of(std::uint32_t triangle) const { return patches_[triangle]; }  ///< below count(); not if left out
  /// Returns whether a triangle was turned.
  bool turned(std::uint32_t triangle) const { return (parents_[triangle] & 1U) != 0; }
  /// Returns 1 if a triangle, turned as its patch is, passes its edge towards the higher vertex, else -1.
  int direction(const HalfEdge& edge) const { return edge.upwards() != turned(edge.triangle()) ? 1 : -1; }

  /// Returns the edges that have not exactly two triangles, or two that clash.
  const std::vector<EdgeGroups::Group>& irregular() const { return irregular_; }

 private:
  std::uint32_t root(std::uint32_t triangle);
  bool unite(const HalfEdge& a, const HalfEdge& b);

  std::vector<std::uint32_t> parents_;  // twice a triangle of the same patch; plus 1 if turned against it
  std::vector<std::uint32_t> patches_;
  std::vector<EdgeGroups::Group> irregular_;
  std::uint32_t count_ = 0;
};

/// Calls a function with each patch (or part) at an edge, the number of its triangles that pass the edge upwards less those
/// that pass it downwards, and the number of all.
template <typename Sorted, typename Function>
void forEachPatchAt(const EdgeGroups::Group& group, const Sorted& patches, const Function& function) {
  std::vector<std::pair<std::uint32_t, int>> uses;
  for (const HalfEdge& edge : group) uses.emplace_back(patches.of(edge.triangle()), patches.direction(edge));
  std::sort(uses.begin(), uses.end());
  for (auto first = uses.begin(); first != uses.end();) {
    int sum = 0;
    auto next = first;
    for (; next != uses.end() && next->first == first->first; ++next) sum += next->second;
    function(first->first, sum, next - first);
    first = next;
  }
}

}  // namespace sweep_guard_core
