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
  std::vector<std::uint32_t> allowed;     ///< touched by links that may, without those above
  std::vector<std::uint32_t> intended;    ///< without those above

  bool operator==(const Highlights& other) const {
    return touched == other.touched && reflex == other.reflex && considered == other.considered &&
           allowed == other.allowed && intended == other.intended;
  }
};

/// Assigns each triangle to its most urgent list. Drops indices that the workpiece does not have.
/// @param intended   where contact is meant
/// @param triangles  number of triangles of the workpiece
Highlights highlightsOf(const sweep_guard::ObjectView& view, const std::vector<std::uint32_t>& intended,
                        size_t triangles);

}  // namespace sweep_guard_rviz
