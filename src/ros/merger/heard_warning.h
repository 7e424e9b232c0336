#pragma once

#include <sweep_guard/Warning.h>

#include "monitor/warning_merger.h"

namespace sweep_guard_ros {

/// Returns a warning that was received now.
/// @throws sweep_guard_core::InvalidInput if its level is unknown
sweep_guard_core::HeardWarning heardFrom(const sweep_guard::Warning& message);

}  // namespace sweep_guard_ros
