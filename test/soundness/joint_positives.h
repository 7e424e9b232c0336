#pragma once

#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// Returns a body of a robot, and 400 small triangles through exactly known points of it while its root and its 2 to 7
/// joints move: the body is the tool, and its motion is that between two states of the robot, with the bound on how far
/// joints bend it. Where the points are is computed in long double from the joints' positions; the product's poses of
/// the ends are not used.
SweepCase jointPositives(std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
