#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// Describes what the surface of a mesh encloses, whatever form the sender gave it. Corners at one place are one
/// corner: first those at equal positions, then those on borders that lie within kWeld of each other. Of faces that are
/// there several times one is kept, in whatever direction. The surface then consists of patches, joined where exactly
/// two triangles share an edge. A patch that hangs on the rest by edges with an odd number of triangles, as a fin or a
/// plate inside, encloses nothing and is left out. Patches with a border are joined where they share it: two solids
/// with a common face. A part without a border is closed; it is turned outwards, and inwards if it is a cavity: if its
/// corners lie in another closed part against which the sender has reversed it. All other parts are open. Indices are
/// the sender's; where corners are welded, that of the first one at that place. Computed once: it holds for every
/// deformation that keeps welded corners together.
class Enclosure {
 public:
  static constexpr double kWeld = 1e-6;  ///< of the diagonal of the box around all vertices

  /// A part with a border, and the fan that closes it: its own triangles are the first.
  struct OpenPart {
    std::uint32_t first;  ///< in openTriangles()
    std::uint32_t own;    ///< number of triangles of the part, > 0
    std::uint32_t caps;   ///< number of triangles of the fan, which follow them
  };

  /// What is known of one triangle of the mesh.
  enum class Role : std::uint8_t { kOutward, kReversed, kOpen, kLeftOut };

  Enclosure() = default;  ///< of a surface that encloses nothing
  /// @param positions  x0 y0 z0 x1 ... [m], finite; not checked
  /// @param triangles  indices below the number of vertices; not checked
  Enclosure(const std::vector<float>& positions, const std::vector<Triangle>& triangles);

  /// Returns the triangles of closed parts, counter-clockwise seen from outside.
  const std::vector<Triangle>& closedTriangles() const { return closed_; }
  /// Returns the triangles of the open parts and their fans, each patch in one direction: that of most of its triangles
  /// as sent. Empty if there are more borders than a quarter of the triangles (and 1 024), as of a heap of single ones.
  const std::vector<Triangle>& openTriangles() const { return open_; }
  const std::vector<OpenPart>& openParts() const { return open_parts_; }  ///< in the order of openTriangles()
  /// Returns what became of triangle `i` of the mesh: it bounds a solid as sent or reversed, it belongs to an open part, or
  /// it is left out, as a second time or as a fin.
  Role role(size_t i) const { return roles_.empty() ? Role::kOpen : roles_[i]; }
  /// Returns the number of edges at the borders of open parts. 0: the surface is closed, but for what is left out.
  size_t openEdges() const { return open_edges_; }
  /// Returns whether closed parts overlap: what they have in common is enclosed twice. Those that only touch do not. Also true
  /// of more than 1 000 closed parts, and where too many triangles of several parts are close to each other: it is not known.
  bool partsOverlap() const { return parts_overlap_; }

 private:
  std::vector<Triangle> closed_;
  std::vector<Triangle> open_;
  std::vector<OpenPart> open_parts_;
  std::vector<Role> roles_;
  size_t open_edges_ = 0;
  bool parts_overlap_ = false;
};

}  // namespace sweep_guard_core
