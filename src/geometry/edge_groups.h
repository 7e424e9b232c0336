#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// One side of a triangle, in the direction in which the triangle passes the edge.
struct HalfEdge {
  std::uint32_t high;  ///< the vertex of the edge with the higher index
  std::uint32_t use;   ///< twice the triangle; plus 1 if it passes the edge towards the higher vertex

  std::uint32_t triangle() const { return use >> 1U; }
  bool upwards() const { return (use & 1U) != 0; }
};

/// Groups the sides of triangles by their edges, in linear time.
class EdgeGroups {
 public:
  /// The triangles at one edge.
  struct Group {
    std::uint32_t low;  ///< the vertex of the edge with the lower index
    const HalfEdge* first;
    const HalfEdge* last;  ///< one past the last

    const HalfEdge* begin() const { return first; }
    const HalfEdge* end() const { return last; }
    size_t size() const { return static_cast<size_t>(last - first); }
  };

  /// @param triangles  fewer than 2^31, with three different corners if they are not left out
  /// @param left_out   of each triangle whether it does not count
  EdgeGroups(const std::vector<Triangle>& triangles, const std::vector<bool>& left_out, size_t vertex_count);

  template <typename Function>
  void forEach(const Function& function) const {
    for (std::uint32_t low = 0; low + 1 < begin_.size(); ++low) {
      const HalfEdge* const last = edges_.data() + begin_[low + 1];
      for (const HalfEdge* first = edges_.data() + begin_[low]; first != last;) {
        const HalfEdge* next = first + 1;
        while (next != last && next->high == first->high) ++next;
        function(Group{low, first, next});
        first = next;
      }
    }
  }

 private:
  std::vector<std::uint32_t> begin_;  // of the edges of each vertex
  std::vector<HalfEdge> edges_;
};

}  // namespace sweep_guard_core
