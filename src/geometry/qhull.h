#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sweep_guard_core {

/// Indices of the corners of a facet, as many as the points have dimensions.
using Facet = std::vector<std::uint32_t>;

/// Computes the facets of the convex hull of points by Qhull [Barber et al. 1996]. Any threads may call it at once.
/// @param points  a column for each, of 2 to 4 finite coordinates of about 1: Qhull has absolute tolerances
/// @returns the facets, those in 3 dimensions counter-clockwise seen from outside; empty if the points span fewer
///     dimensions or Qhull fails
/// @throws DeviceError if /dev/null cannot be opened
std::optional<std::vector<Facet>> hullFacets(const Eigen::MatrixXd& points);

/// Computes the Delaunay tetrahedra of points by Qhull: no point lies inside the sphere through the corners of one,
/// except for Qhull's tolerance. Any threads may call it at once.
/// @param points  a column for each, finite, of about 1
/// @returns the indices of the corners of each; none if the points lie in a plane or Qhull fails
/// @throws DeviceError if /dev/null cannot be opened
std::vector<std::array<std::uint32_t, 4>> delaunayTetrahedra(const Eigen::Matrix3Xd& points);

}  // namespace sweep_guard_core
