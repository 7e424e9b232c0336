#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <optional>
#include <vector>

namespace sweep_guard_core {

/// The half-space {y : normal · y <= offset} of R^4.
struct HalfSpace4 {
  Eigen::Vector4d normal;  ///< unit
  double offset;           ///< >= 0 if the origin belongs to the half-space
};

/// The point of a polyhedron that is nearest to a target, with the proof of it: target - point = sum of multipliers[i] *
/// normal of the half-space active[i], the point is in the plane of each active half-space, and no multiplier is
/// negative. The normals of the active half-spaces are linearly independent.
struct NearestPoint {
  Eigen::Vector4d point;
  boost::container::static_vector<size_t, 4> active;       ///< indices of half-spaces
  boost::container::static_vector<double, 4> multipliers;  ///< of these
};

/// Computes the point of an intersection of half-spaces nearest to `target`, by the dual active-set method of Goldfarb
/// and Idnani (1983): begins at the target and adds the half-space that is violated most, until none is. The number of
/// half-spaces is not limited; nothing is allocated. The point may lie outside of a half-space by 1e-13, or by up to 1e-6
/// where normals are within 1e-8 of linear dependence.
/// @returns empty if the half-spaces have no point in common, or if rounding kept it from an answer: after 200 steps, or
/// without a direction to go on in
std::optional<NearestPoint> nearestPoint(const Eigen::Vector4d& target, const std::vector<HalfSpace4>& half_spaces);

}  // namespace sweep_guard_core
