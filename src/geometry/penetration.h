#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>
#include <functional>

#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// Returns the distance [m] that the tool must move along `normal` to separate from the obstacle: max over the obstacle
/// of normal · p - min over the tool of normal · q. Negative if the bodies are already separated along `normal`.
double depthAlong(const Eigen::Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle);

/// Unit directions to try.
using Proposals = boost::container::static_vector<Eigen::Vector3d, 27>;
using NeighborNormals = boost::container::static_vector<Eigen::Vector3d, 8>;

/// Returns whether a direction, with its depthAlong() [m], is known to be a local minimum: the bodies touch once the tool is
/// moved out along it. False if in doubt.
using IsLocalMinimum = std::function<bool(const Eigen::Vector3d& direction, double depth)>;

/// Returns the minimum translation direction of two overlapping convex bodies: the unit direction with the least
/// depthAlong(). The caller proposes directions. The best proposal is improved until nothing is gained: the tool is moved
/// out along it, and the direction of the closest points replaces it, which never increases the depth. The result is a
/// local minimum; the proposals make it the global one. Unless it is near a normal of the neighborhood, the expanding
/// polytope algorithm of libccd proposes another direction, and the better result counts. Face normals are proposals that
/// serve flat bodies, for which libccd makes no polytope.
/// @param proposals  not empty
/// @param neighbors  minimum translation directions of bodies near the obstacle; the last is a further proposal
/// @param size       approximate size of the smaller body [m], > 0
/// @param is_local_minimum  saves the search for an improvement
Eigen::Vector3d minimumTranslationDirection(
    const SupportMapping& tool, const SupportMapping& obstacle, const Proposals& proposals,
    const NeighborNormals& neighbors, double size,
    const IsLocalMinimum& is_local_minimum = [](const auto& /*direction*/, double /*depth*/) { return false; });

}  // namespace sweep_guard_core
