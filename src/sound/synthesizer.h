#pragma once

#include <cstdint>
#include <vector>

#include "sound/earcon.h"

namespace sweep_guard_core {

/// Turns earcons into samples: signed 16 bits, one channel.
class Synthesizer {
 public:
  /// @param rate  samples per second, > 0
  explicit Synthesizer(double rate) : rate_(rate) {}

  /// Appends samples. Beeps that only come faster or slower go on from the last one; another sound begins at once, or
  /// after 5 ms where one has just begun, while what there was fades within 5 ms.
  void render(const Earcon& earcon, size_t count, std::vector<std::int16_t>& samples);

  double rate() const { return rate_; }

 private:
  void turnTo(const Earcon& earcon);
  double next();

  double rate_;
  Earcon playing_;
  double time_ = 0.0;  // [s] since the begin of a beep
  Earcon fading_;
  double fading_time_ = 0.0;  // the same of what fades
  double faded_ = kFade;      // [s] for how long it has

  static constexpr double kFade = 0.005;  // [s]
};

}  // namespace sweep_guard_core
