#include "sweep_guard/haptics/stiffness_bound.h"

#include <algorithm>

namespace sweep_guard_core {

double maxStiffness(const SampledDevice& device, double delay) {
  return std::max(0.0, device.damping - device.virtual_damping) / (device.period / 2 + delay);
}

double dampingWithLever(double damping, double turn_damping, double lever) {
  return 1.0 / (1.0 / damping + lever * lever / turn_damping);
}

}  // namespace sweep_guard_core
