#include "simulation/pose_scheduler.h"

namespace sweep_guard_simulation {

bool PoseScheduler::resume(sweep_guard_core::Time stamp, sweep_guard_core::Time now) {
  const sweep_guard_core::Duration delay = now - due(stamp);
  if (!live_ || delay <= kStall) return false;
  start_ += delay;
  return true;
}

}  // namespace sweep_guard_simulation
