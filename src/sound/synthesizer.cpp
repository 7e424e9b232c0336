#include "sound/synthesizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sweep_guard_core {
namespace {

bool sameBeep(const Earcon& a, const Earcon& b) {
  return std::tie(a.length, a.first, a.second, a.amplitude) == std::tie(b.length, b.first, b.second, b.amplitude) &&
         a.steady() == b.steady();
}

}  // namespace

void Synthesizer::render(const Earcon& earcon, size_t count, std::vector<std::int16_t>& samples) {
  for (size_t i = 0; i < count; ++i) {
    turnTo(earcon);
    const double value = std::clamp(next(), -1.0, 1.0);
    samples.push_back(static_cast<std::int16_t>(std::lround(value * std::numeric_limits<std::int16_t>::max())));
  }
}

void Synthesizer::turnTo(const Earcon& earcon) {
  if (!sameBeep(playing_, earcon)) {
    if (faded_ < kFade) return;
    fading_ = playing_;
    fading_time_ = time_;
    faded_ = 0.0;
    time_ = 0.0;
  }
  playing_ = earcon;
}

double Synthesizer::next() {
  const double step = 1.0 / rate_;
  double value = sampleOf(playing_, time_);
  if (faded_ < kFade) {
    value = std::min(1.0, faded_ / kFade) * value + (1.0 - faded_ / kFade) * sampleOf(fading_, fading_time_);
    fading_time_ += step;
    faded_ += step;
  }
  time_ += step;
  if (time_ >= playing_.period) time_ = time_ - playing_.period < step ? time_ - playing_.period : 0.0;
  return value;
}

}  // namespace sweep_guard_core
