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

/// Returns how it sounds that a motion guard holds the robot back: a low warble between two tones, unlike any warning, the
/// louder the more is held back.
/// @param share  of the command, in [0, 1]; 0: silence
Earcon heldEarcon(double share);

/// A sound at one moment.
struct Sound {
  double value = 0.0;     ///< in [-loudness, loudness]
  double loudness = 0.0;  ///< in [0, 1]
};

/// Plays one earcon after another. Beeps begin and end within 4 ms without a click. Those that only come faster or slower go on
/// from the last one, and a tone without end that only gets louder goes on; another sound begins at once, or after 5 ms where one
/// has just begun, while what there was fades within 5 ms.
class Voice {
 public:
  /// Returns the sound now, and moves on.
  /// @param step  [s] until the next call
  Sound next(const Earcon& earcon, double step);

 private:
  void turnTo(const Earcon& earcon);

  Earcon playing_;
  double time_ = 0.0;  // [s] since the begin of a beep
  Earcon fading_;
  double fading_time_ = 0.0;  // the same of what fades
  double faded_ = kFade;      // [s] for how long it has

  static constexpr double kFade = 0.005;  // [s]
};

/// Turns earcons into samples: signed 16 bits, one channel.
class Synthesizer {
 public:
  /// @param rate    samples per second, > 0
  /// @param volume  in [0, 1]
  explicit Synthesizer(double rate, double volume = 1.0) : rate_(rate), volume_(volume) {}

  /// Appends samples: each earcon by a Voice of its own.
  /// @param behind  sounds in what room `earcon` leaves: as loud as it is in the gaps, not at all behind the loudest sound
  void render(const Earcon& earcon, size_t count, std::vector<std::int16_t>& samples, const Earcon& behind = {});

  double rate() const { return rate_; }

 private:
  double rate_;
  double volume_;
  Voice voice_;
  Voice behind_;
};

/// Returns samples as a WAV file: PCM, signed 16 bits, one channel.
/// @param rate  samples per second
/// @throws InvalidInput if there are more than a WAV file can hold: 2 GiB
std::string wavFile(const std::vector<std::int16_t>& samples, std::uint32_t rate);

}  // namespace sweep_guard_core
