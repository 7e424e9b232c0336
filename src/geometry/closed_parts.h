#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/surface_parts.h"
#include "geometry/welded_surface.h"

namespace sweep_guard_core {

/// Finds out how the closed parts of a surface lie to each other: which are cavities of others, and whether two overlap.
class ClosedParts {
 public:
  /// Arguments must live as long as this.
  ClosedParts(const WeldedSurface& surface, const SurfaceParts& parts, const std::vector<Shell>& shells);

  bool isCavity(std::uint32_t part) const { return cavities_[part]; }
  bool overlap() const { return overlap_; }

 private:
  bool anyBoxesMeet() const;
  bool anyCrossOrLieInOthers() const;
  int turnsAround(std::uint32_t inner) const;
  bool areSentInBothDirections() const;
  void collectTriangles();
  bool isReversedAgainstOutermost(std::uint32_t inner) const;
  bool encloses(std::uint32_t outer, std::uint32_t inner) const;
  bool enclosesMost(std::uint32_t outer, std::uint32_t inner) const;
  Eigen::Vector3d cornerOf(std::uint32_t part, size_t i) const;
  bool enclosesPoint(std::uint32_t outer, const Eigen::Vector3d& p) const;

  const WeldedSurface& surface_;
  const SurfaceParts& parts_;
  const std::vector<Shell>& shells_;
  std::vector<std::uint32_t> closed_;
  std::vector<std::vector<Triangle>> triangles_;  // of each closed part, in the direction of the part
  std::vector<bool> cavities_;
  double least_;  // distance that counts [m]
  bool overlap_ = false;
};

}  // namespace sweep_guard_core
