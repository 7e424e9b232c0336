#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// Descends the tree of a tool to its convex pieces, depth first. What does not meet a box meets no piece inside of it: the
/// visitor says of each box whether to go on below. A visitor has three functions:
///
///     std::optional<State> enter(size_t box, const State& above)  empty: leaves out all pieces in the box
///     std::array<size_t, 2> order(const Tool::Node& box)          the nodes below, as they are to be visited
///     bool visit(size_t piece, const State& above)                returns whether the walk ends
///
/// @param node   index in Tool::tree() of the node to begin at; so are `box` and `piece`
/// @param above  state of the node above, which enter() returned
/// @returns whether a visit ended the walk
template <typename State, typename Visitor>
bool walkTree(const Tool& tool, size_t node, const State& above, Visitor& visitor) {
  const Tool::Node& at = tool.tree()[node];
  if (at.piece) return visitor.visit(node, above);
  const std::optional<State> here = visitor.enter(node, above);
  if (!here) return false;
  const auto order = visitor.order(at);
  return std::any_of(order.begin(), order.end(), [&](size_t below) { return walkTree(tool, below, *here, visitor); });
}

}  // namespace sweep_guard_core
