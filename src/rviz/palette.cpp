#include "rviz/palette.h"

namespace sweep_guard_rviz {

QColor colorOf(Light light) {
  switch (light) {
    case Light::kClear:
      return {46, 176, 92};
    case Light::kConsidered:
      return {255, 176, 0};
    case Light::kReflex:
    case Light::kContact:
      return {222, 26, 26};
    case Light::kUnknown:
      break;
  }
  return {140, 144, 150};
}

QColor inkOn(Light light) {
  const bool pale = light == Light::kUnknown || light == Light::kConsidered;
  return pale ? QColor(16, 16, 18) : QColor(255, 255, 255);
}

QColor backdrop() { return {30, 32, 36}; }

QColor unlit() { return {62, 65, 71}; }

}  // namespace sweep_guard_rviz
