#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <optional>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// Descends the tree of a tool to its convex pieces, depth first. What does not meet a box meets no piece inside of it, so
/// the caller says of each box whether to go below:
///
///     TreeWalk<State> walk(state_of_the_root);
///     while (const auto at = walk.next()) {
///       const Tool::Node& node = tool.tree()[at->node];
///       if (node.piece) test(*node.piece);
///       else if (meets(node)) walk.goBelow(node.below, state);
///     }
///
/// @tparam State  what a node hands down to the two below it
template <typename State>
class TreeWalk {
 public:
  struct Stop {
    size_t node;  ///< index into Tool::tree()
    State above;  ///< state that was handed down to it
  };

  explicit TreeWalk(const State& above) { stops_.push_back({0, above}); }

  /// Returns the next node; empty at the end.
  std::optional<Stop> next() {
    if (stops_.empty()) return std::nullopt;
    const Stop stop = stops_.back();
    stops_.pop_back();
    return stop;
  }

  /// Visits the nodes below the last one next, before all others.
  /// @param order  Tool::Node::below, as they are to be visited
  void goBelow(const std::array<size_t, 2>& order, const State& here) {
    stops_.push_back({order[1], here});
    stops_.push_back({order[0], here});
  }

 private:
  boost::container::small_vector<Stop, 32> stops_;  // the next one last; deeper trees allocate
};

}  // namespace sweep_guard_core
