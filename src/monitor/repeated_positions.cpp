#include "monitor/repeated_positions.h"

namespace sweep_guard_core {

void RepeatedPositions::add(const Eigen::Isometry3d& X_WT, const std::vector<double>& joints) {
  if (X_WT_) {
    ++states_;
    if (*X_WT_ == X_WT.matrix() && joints_ == joints) ++repeated_;
  }
  X_WT_ = X_WT.matrix();
  joints_ = joints;
}

std::optional<double> repeatedPercent(const RepeatedPositions::Counts& before, const RepeatedPositions::Counts& after) {
  if (after.states == before.states) return {};
  return 100.0 * static_cast<double>(after.repeated - before.repeated) /
         static_cast<double>(after.states - before.states);
}

}  // namespace sweep_guard_core
