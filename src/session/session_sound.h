#pragma once

#include <cstdint>
#include <vector>

#include "session/session_log.h"

namespace sweep_guard_session {

/// Returns what an operator would have heard from the first warning to the end of the session: signed 16 bits, one channel.
/// @param rate  samples per second, > 0
std::vector<std::int16_t> soundOf(const SessionLog& log, double rate);

}  // namespace sweep_guard_session
