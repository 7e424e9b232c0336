#pragma once

#include <sweep_guard/ObjectView.h>

#include <cstdint>
#include <vector>

namespace sweep_guard_rviz {

/// Lists the triangles of a workpiece that are shown in a color of their own: ascending, each triangle in one list.
struct Highlights {
  std::vector<std::uint32_t> touched;
  std::vector<std::uint32_t> reflex;      ///< without those in touched
  std::vector<std::uint32_t> considered;  ///< without those in touched and reflex

  bool operator==(const Highlights& other) const {
    return touched == other.touched && reflex == other.reflex && considered == other.considered;
  }
};

/// Assigns each triangle to its most urgent list. Drops indices that the workpiece does not have.
/// @param triangles  number of triangles of the workpiece
Highlights highlightsOf(const sweep_guard::ObjectView& view, size_t triangles);

}  // namespace sweep_guard_rviz
