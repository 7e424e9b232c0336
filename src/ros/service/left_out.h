#pragma once

#include <string>

#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_ros {

/// Says which allowed pairs (tool/allowed) a test against these workpieces has left out; empty: none.
std::string describeLeftOut(const sweep_guard_core::AllowedPairs& pairs,
                            const sweep_guard_core::Workpieces& workpieces);

}  // namespace sweep_guard_ros
