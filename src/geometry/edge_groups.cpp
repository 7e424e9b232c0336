#include "geometry/edge_groups.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

template <typename Function>
void forEachSide(const std::vector<Triangle>& triangles, const std::vector<bool>& left_out, const Function& function) {
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (left_out[i]) continue;
    const auto& [a, b, c] = triangles[i];
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      function(std::min(from, to), HalfEdge{std::max(from, to), i << 1U | (from < to ? 1U : 0U)});
    }
  }
}

bool before(const HalfEdge& a, const HalfEdge& b) { return a.high != b.high ? a.high < b.high : a.use < b.use; }

}  // namespace

EdgeGroups::EdgeGroups(const std::vector<Triangle>& triangles, const std::vector<bool>& left_out, size_t vertex_count)
    : begin_(vertex_count + 1) {
  forEachSide(triangles, left_out, [&](std::uint32_t low, const HalfEdge&) { ++begin_[low]; });
  std::uint32_t end = 0;
  for (std::uint32_t& begin : begin_) begin = end += begin;
  edges_.resize(end);
  forEachSide(triangles, left_out, [&](std::uint32_t low, const HalfEdge& edge) { edges_[--begin_[low]] = edge; });
  for (size_t i = 0; i + 1 < begin_.size(); ++i) {
    std::sort(edges_.begin() + begin_[i], edges_.begin() + begin_[i + 1], before);
  }
}

}  // namespace sweep_guard_core
