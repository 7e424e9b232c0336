#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sweep_guard_core {

/// Returns samples as a WAV file: PCM, signed 16 bits, one channel.
/// @param rate  samples per second
/// @throws InvalidInput if there are more than a WAV file can hold: 2 GiB
std::string wavFile(const std::vector<std::int16_t>& samples, std::uint32_t rate);

}  // namespace sweep_guard_core
