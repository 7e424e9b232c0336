#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "geometry/patches.h"
#include "geometry/welded_surface.h"

namespace sweep_guard_core {

/// Joins patches into parts where one alone has a border: two solids that share a face. Each patch is turned as most of its
/// triangles were sent.
class SurfaceParts {
 public:
  /// @param patches  of the surface; must live as long as this
  SurfaceParts(const WeldedSurface& surface, const Patches& patches);

  std::uint32_t count() const { return count_; }
  std::uint32_t of(std::uint32_t triangle) const { return parts_[patches_.of(triangle)]; }
  bool turned(std::uint32_t triangle) const { return patches_.turned(triangle) != flipped_[patches_.of(triangle)]; }
  const std::vector<EdgeGroups::Group>& irregular() const { return patches_.irregular(); }
  int direction(const HalfEdge& edge) const { return edge.upwards() != turned(edge.triangle()) ? 1 : -1; }

 private:
  std::uint32_t root(std::uint32_t patch);
  void uniteBordersAt(const EdgeGroups::Group& group);

  const Patches& patches_;
  std::vector<bool> flipped_;
  std::vector<std::uint32_t> parents_;  // a patch of the same part that comes before, or the patch itself
  std::vector<std::uint32_t> parts_;
  std::uint32_t count_ = 0;
};

/// An edge at the border of a part, in the direction in which its triangle passes it.
struct Border {
  std::uint32_t part;
  std::uint32_t from;
  std::uint32_t to;
  bool again;  ///< as before: directions clash at this edge
};

/// Returns the borders, by part.
std::vector<Border> bordersOf(const SurfaceParts& parts);

/// Sums over the triangles of a part.
struct Shell {
  bool closed = true;
  bool both_ways = false;  ///< a triangle was sent in both directions
  std::uint32_t count = 0;
  std::uint32_t turned = 0;  ///< triangles that the part has turned
  double six_volumes = 0.0;  ///< signed [m^3], as the part is turned
  Eigen::AlignedBox3d box = {};

  /// Returns whether the part has to be turned once more to face outwards.
  bool isInsideOut() const { return six_volumes < 0.0; }
  /// Returns whether the sender's direction is known, and the same for all triangles.
  bool isSentInOneDirection() const { return !both_ways && (turned == 0 || turned == count); }
  bool isSentInsideOut() const { return (turned == 0) == isInsideOut(); }
};

std::vector<Shell> shellsOf(const WeldedSurface& surface, const SurfaceParts& parts,
                            const std::vector<Border>& borders);

}  // namespace sweep_guard_core
