#include "soundness/report.h"

namespace sweep_guard_core::soundness {

void Report::fail(const std::string& what, const std::function<std::string()>& text) {
  constexpr std::uint64_t kShown = 5;
  if (++failures_ <= kShown) out_ << "FAILED: " << what << '\n' << text() << std::flush;
}

void Report::summarize() const {
  for (const auto& [family, detectors] : tallies_) {
    for (const auto& [detector, tally] : detectors) {
      out_ << "detector " << detector << " family " << family << " cases " << tally.cases << " positives "
           << tally.positives << " misses " << tally.misses << " extras " << tally.extras << " unexplained "
           << tally.unexplained << '\n';
    }
  }
  out_ << "failures " << failures_ << std::endl;
}

}  // namespace sweep_guard_core::soundness
