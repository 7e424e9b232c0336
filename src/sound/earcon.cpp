#include "sound/earcon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kRamp = 0.004;          // of a beep [s]
constexpr double kSoonest = 0.1;         // time to collision [s] of the fastest beeps
constexpr double kLatest = 1.0;          // time to collision [s] of the slowest
constexpr double kFastPeriod = 0.1;      // [s]
constexpr double kSlowPeriod = 0.6;      // [s]
constexpr double kProbablePeriod = 0.8;  // [s], of a collision that is only probable
constexpr double kQuieter = 0.25;        // what is acknowledged
constexpr Earcon kUnknownTone = {1.0, 0.24, 300.0, 225.0, 0.6};
constexpr Earcon kTick = {2.0, 0.012, 1500.0, 1500.0, 0.15};
constexpr Earcon kSilence = {2.0, 0.012, 1500.0, 1500.0, 0.0};
constexpr Earcon kWarble = {0.1, 0.1, 480.0, 640.0, 0.0};  // whole waves in a period, as of the next
constexpr double kHeldSoftest = 0.2;
constexpr double kHeldLoudest = 0.5;
constexpr Earcon kContactTone = {1.0, 1.0, 1000.0, 1000.0, 1.0};  // it joins its repetition

double periodOf(const std::optional<Duration>& time_to_collision) {
  if (!time_to_collision) return kProbablePeriod;
  const double share = (toSeconds(*time_to_collision) - kSoonest) / (kLatest - kSoonest);
  return kFastPeriod + std::clamp(share, 0.0, 1.0) * (kSlowPeriod - kFastPeriod);
}

double envelope(const Earcon& earcon, double time) {
  if (earcon.steady()) return 1.0;
  return std::clamp(std::min(time, earcon.length - time) / kRamp, 0.0, 1.0);
}

bool sameBeep(const Earcon& a, const Earcon& b) {
  return std::tie(a.length, a.first, a.second, a.amplitude) == std::tie(b.length, b.first, b.second, b.amplitude) &&
         a.steady() == b.steady();
}

bool sameTone(const Earcon& a, const Earcon& b) {
  return a.steady() &&
         std::tie(a.period, a.length, a.first, a.second) == std::tie(b.period, b.length, b.first, b.second);
}

Sound soundAt(const Earcon& earcon, double time) {
  const double t = std::fmod(time, earcon.period);
  const double half = 0.5 * earcon.length;
  const double waves = t < half ? earcon.first * t : earcon.first * half + earcon.second * (t - half);
  const double loudness = earcon.amplitude * envelope(earcon, t);
  return {loudness * std::sin(2.0 * M_PI * waves), loudness};
}

constexpr std::uint32_t kBytesPerSample = 2;
constexpr std::uint32_t kHeader = 36;  // bytes of the header after the size of the file

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFFU));
}

}  // namespace

Earcon earconOf(const MergedWarning& warning, bool clear_tick) {
  switch (warning.level) {
    case WarningLevel::kClear:
      return clear_tick ? kTick : kSilence;
    case WarningLevel::kConsidered:
      return {periodOf(warning.time_to_collision), 0.06, 800.0, 800.0, warning.acknowledged ? kQuieter * 0.8 : 0.8};
    case WarningLevel::kReflex:
      return {kFastPeriod, 0.06, 1000.0, 1000.0, 1.0};
    case WarningLevel::kContact:
      return kContactTone;
    default:
      return kUnknownTone;
  }
}

Earcon heldEarcon(double share) {
  Earcon earcon = kWarble;
  if (share > 0.0) earcon.amplitude = kHeldSoftest + share * (kHeldLoudest - kHeldSoftest);
  return earcon;
}

void Voice::turnTo(const Earcon& earcon) {
  if (!sameBeep(playing_, earcon)) {
    if (faded_ < kFade) return;
    fading_ = playing_;
    fading_time_ = time_;
    faded_ = 0.0;
    if (!sameTone(playing_, earcon)) time_ = 0.0;
  }
  playing_ = earcon;
}

Sound Voice::next(const Earcon& earcon, double step) {
  turnTo(earcon);
  Sound sound = soundAt(playing_, time_);
  if (faded_ < kFade) {
    const double share = faded_ / kFade;
    const Sound fading = soundAt(fading_, fading_time_);
    sound = {share * sound.value + (1.0 - share) * fading.value,
             share * sound.loudness + (1.0 - share) * fading.loudness};
    fading_time_ += step;
    faded_ += step;
  }
  time_ += step;
  if (time_ >= playing_.period) time_ = time_ - playing_.period < step ? time_ - playing_.period : 0.0;
  return sound;
}

void Synthesizer::render(const Earcon& earcon, size_t count, std::vector<std::int16_t>& samples, const Earcon& behind) {
  for (size_t i = 0; i < count; ++i) {
    const Sound front = voice_.next(earcon, 1.0 / rate_);
    const double value = front.value + (1.0 - front.loudness) * behind_.next(behind, 1.0 / rate_).value;
    samples.push_back(
        static_cast<std::int16_t>(std::lround(volume_ * value * std::numeric_limits<std::int16_t>::max())));
  }
}

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
