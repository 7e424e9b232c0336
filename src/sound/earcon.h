#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "monitor/warning_merger.h"

namespace sweep_guard_core {

/// A beep that repeats, in two halves, each of one tone.
struct Earcon {
  double period = 1.0;     ///< [s] from the begin of a beep to that of the next, >= `length`
  double length = 1.0;     ///< [s] of a beep, > 0; `period`: a tone without end, of whole waves
  double first = 0.0;      ///< tone of the first half [Hz]
  double second = 0.0;     ///< tone of the second half [Hz]
  double amplitude = 0.0;  ///< in [0, 1]; 0: silence

  bool steady() const { return length >= period; }
};

/// Returns how a warning sounds, like a parking aid: beeps that follow each other faster the sooner the collision is, a steady
/// tone in contact, a low double tone for kUnknown, a soft tick every 2 s for kClear. What is acknowledged is quieter.
/// @param clear_tick  false: kClear is silent
Earcon earconOf(const MergedWarning& warning, bool clear_tick);

/// Returns the sound at one moment, in [-1, 1]. Beeps begin and end within 4 ms without a click.
/// @param time  [s] since the begin of a beep, >= 0
double sampleOf(const Earcon& earcon, double time);

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

/// Returns samples as a WAV file: PCM, signed 16 bits, one channel.
/// @param rate  samples per second
/// @throws InvalidInput if there are more than a WAV file can hold: 2 GiB
std::string wavFile(const std::vector<std::int16_t>& samples, std::uint32_t rate);

}  // namespace sweep_guard_core
