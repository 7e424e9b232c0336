#pragma once

#include <cstdint>
#include <vector>

#include "geometry/edge_groups.h"

namespace sweep_guard_core {

/// Sorts triangles into patches: two belong to one patch if they are alone at an edge, or by way of others. The triangles of a patch
/// are turned into one direction, that of its first triangle. A patch that cannot be, as a Moebius strip, has borders
/// where directions clash.
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

}  // namespace sweep_guard_core
