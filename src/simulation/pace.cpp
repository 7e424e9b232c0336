#include "simulation/pace.h"

namespace sweep_guard_simulation {

bool Pace::resume(sweep_guard::Time stamp, sweep_guard::Time now) {
  const sweep_guard::Duration delay = now - due(stamp);
  if (!live_ || delay <= kStall) return false;
  start_ += delay;
  return true;
}

}  // namespace sweep_guard_simulation
