#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// Returns the distance [m] that the tool must move along `normal` to separate from the obstacle: max over the obstacle
/// of normal · p - min over the tool of normal · q. Negative if the bodies are already separated along `normal`.
double depthAlong(const Eigen::Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle);

/// Unit directions to try.
using Proposals = boost::container::static_vector<Eigen::Vector3d, 26>;

/// Returns the minimum translation direction of two overlapping convex bodies: the unit direction with the least
/// depthAlong(). The expanding polytope algorithm of libccd proposes one direction, the caller others. The best
/// proposal is improved until nothing is gained: the tool is moved out along it, and the direction of the closest
/// points replaces it, which never increases the depth. The result is a local minimum; the proposals make it the global
/// one. Face normals are proposals that serve flat bodies, for which libccd makes no polytope.
/// @param proposals  not empty
/// @param size       approximate size of the smaller body [m], > 0
Eigen::Vector3d minimumTranslationDirection(const SupportMapping& tool, const SupportMapping& obstacle,
                                            const Proposals& proposals, double size);

}  // namespace sweep_guard_core
