#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// How far the tool must go along `normal` to come free of the obstacle [m]: max over the obstacle of normal · p - min
/// over the tool of normal · q. Negative where the tool is free already, by as much.
double depthAlong(const Eigen::Vector3d& normal, const SupportMapping& tool, const SupportMapping& obstacle);

/// Directions to try, unit.
using Proposals = boost::container::static_vector<Eigen::Vector3d, 26>;

/// The direction along which two convex bodies that overlap come apart the soonest. The expanding polytope algorithm of
/// libccd proposes one, the caller others; the best of them, by depthAlong(), is then made better until nothing is
/// gained any more: the tool is drawn out along it and the direction of the closest points is taken instead, which
/// never has the tool go farther. The depth is so the least among the directions nearby; the proposals are what makes
/// it the least of all. They need not be good: a flat body, of which libccd can make no polytope, has its face normals.
/// @param proposals  any number of directions, unit; not empty
/// @param size       of the smaller body, about [m], > 0
Eigen::Vector3d minimumTranslationDirection(const SupportMapping& tool, const SupportMapping& obstacle,
                                            const Proposals& proposals, double size);

}  // namespace sweep_guard_core
