#include "session/session_sound.h"

#include <algorithm>

#include "sound/synthesizer.h"

namespace sweep_guard_session {

std::vector<std::int16_t> soundOf(const SessionLog& log, double rate) {
  std::vector<std::int16_t> samples;
  if (log.warnings().empty()) return samples;
  sweep_guard_core::Synthesizer synthesizer(rate);
  const sweep_guard_core::Time begin = log.warnings().front().received;
  for (size_t i = 0; i < log.warnings().size(); ++i) {
    const ReceivedWarning& warning = log.warnings()[i];
    const bool last = i + 1 == log.warnings().size();
    const sweep_guard_core::Time end =
        last ? std::max(log.endTime(), warning.received) : log.warnings()[i + 1].received;
    const auto until = static_cast<size_t>(sweep_guard_core::toSeconds(end - begin) * rate);
    const sweep_guard_core::SoundCue cue{warning.level, warning.time_to_collision};
    synthesizer.render(earconOf(cue, /*clear_tick=*/true), until - std::min(until, samples.size()), samples);
  }
  return samples;
}

}  // namespace sweep_guard_session
