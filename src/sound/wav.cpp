#include "sound/wav.h"

#include <limits>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint32_t kBytesPerSample = 2;
constexpr std::uint32_t kHeader = 36;  // bytes of the header after the size of the file

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFFU));
}

}  // namespace

std::string wavFile(const std::vector<std::int16_t>& samples, std::uint32_t rate) {
  if (samples.size() > std::numeric_limits<std::int32_t>::max() / kBytesPerSample) {
    throw InvalidInput("a WAV file holds at most 2 GiB: " + std::to_string(samples.size()) + " samples are too many");
  }
  const auto size = static_cast<std::uint32_t>(samples.size()) * kBytesPerSample;
  std::string bytes = "RIFF";
  append(bytes, kHeader + size, 4);
  bytes += "WAVEfmt ";
  append(bytes, 16, 4);  // bytes of the format that follow
  append(bytes, 1, 2);   // PCM
  append(bytes, 1, 2);   // channels
  append(bytes, rate, 4);
  append(bytes, rate * kBytesPerSample, 4);
  append(bytes, kBytesPerSample, 2);
  append(bytes, 8 * kBytesPerSample, 2);
  bytes += "data";
  append(bytes, size, 4);
  for (const std::int16_t sample : samples) append(bytes, static_cast<std::uint16_t>(sample), kBytesPerSample);
  return bytes;
}

}  // namespace sweep_guard_core
