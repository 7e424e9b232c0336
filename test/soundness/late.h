#pragma once

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// Plays one session in which transforms of a workpiece come late and seldom: random rates and delays of poses and transforms, in
/// any order of arrival, and static transforms that change meanwhile. Checks that each triangle through a known point of the tool
/// at a known time is reported once tool and frame are known up to then, and that the warning is CONTACT from then on.
void checkLate(const Context& context, std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
