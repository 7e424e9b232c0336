#include "rviz/palette.h"

namespace sweep_guard_rviz {

QColor colorOf(WarningLevel level) {
  const auto& [red, green, blue] = styleOf(level).rgb;
  return {red, green, blue};
}

QColor inkOn(WarningLevel level) {
  const bool pale = level == WarningLevel::kUnknown || level == WarningLevel::kConsidered;
  return pale ? QColor(16, 16, 18) : QColor(255, 255, 255);
}

QColor heldColor(bool stopped) { return stopped ? QColor(200, 0, 145) : QColor(105, 30, 85); }

QColor backdrop() { return {30, 32, 36}; }

QColor unlit() { return {62, 65, 71}; }

}  // namespace sweep_guard_rviz
