#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Largest number of intentions at once.
constexpr size_t kMaxIntentions = 64;
/// Largest depth of an intention [m].
constexpr double kMaxIntendedDepth = 0.5;

/// A region of a workpiece that links of the tool are meant to touch. It names triangles, so it follows them when the
/// workpiece deforms. It says nothing about a mesh that has other triangles.
struct Intention {
  std::string mesh_id;
  std::shared_ptr<const std::vector<Triangle>> mesh_triangles;  ///< those that `triangles` are indices into
  std::vector<std::uint32_t> triangles;                         ///< ascending, each once
  /// How far the link may reach behind the plane of a triangle that it touches [m], in (0, kMaxIntendedDepth]. It is
  /// measured against the triangle's normal, which points out of the workpiece, and counts all pieces of the link.
  double depth = 0.0;
  std::vector<std::string> tool_links = {};        ///< links that may touch it; empty: all
  std::optional<SteadyTime> until = std::nullopt;  ///< end; empty: until taken back

  bool concerns(const Workpiece& workpiece) const {
    return workpiece.id == mesh_id && &workpiece.mesh_M.triangles() == mesh_triangles.get();
  }
  bool holds(std::uint32_t triangle) const { return std::binary_search(triangles.begin(), triangles.end(), triangle); }
  /// Returns whether this link of the tool may touch the region.
  bool allows(const std::string& link) const {
    return tool_links.empty() || std::find(tool_links.begin(), tool_links.end(), link) != tool_links.end();
  }
};

using Intentions = std::vector<Intention>;

}  // namespace sweep_guard_core
