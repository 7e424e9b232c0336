#pragma once

#include <sweep_guard/ObjectView.h>

#include <cstdint>
#include <vector>

namespace sweep_guard_rviz {

/// Triangles of a workpiece that are shown in a colour of their own: each ascending, no triangle in two of them.
struct Highlights {
  std::vector<std::uint32_t> touched;
  std::vector<std::uint32_t> reflex;      ///< none that is touched
  std::vector<std::uint32_t> considered;  ///< none of the others

  bool operator==(const Highlights& other) const {
    return touched == other.touched && reflex == other.reflex && considered == other.considered;
  }
};

/// The most urgent of what a triangle is. What the workpiece does not have is left out.
/// @param triangles  number of triangles of the workpiece
Highlights highlightsOf(const sweep_guard::ObjectView& view, size_t triangles);

}  // namespace sweep_guard_rviz
