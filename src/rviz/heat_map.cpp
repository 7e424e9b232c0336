#include "rviz/heat_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sweep_guard_rviz {
namespace {

double valueOf(const sweep_guard::ObjectTouches& touches, size_t i, ColorBy by) {
  if (by == ColorBy::kTouches) return touches.sweeps[i];
  return touches.depths[i];
}

// Of the largest value, in [0, 1].
double shareOf(double value, double largest, ColorBy by) {
  if (by == ColorBy::kTouches) return std::log(value) / std::max(std::log(largest), 1e-9);
  return value / std::max(largest, 1e-9);
}

}  // namespace

// ColorBrewer's Purples, from the second of seven on.
const std::array<Ogre::ColourValue, kHeatColors>& heatColors() {
  static const auto kColors = [] {
    constexpr std::uint32_t kRgba[kHeatColors] = {0xDADAEBFF, 0xBCBDDCFF, 0x9E9AC8FF,
                                                  0x807DBAFF, 0x6A51A3FF, 0x4A1486FF};
    std::array<Ogre::ColourValue, kHeatColors> colors;
    for (size_t i = 0; i < kHeatColors; ++i) colors[i].setAsRGBA(kRgba[i]);
    return colors;
  }();
  return kColors;
}

HeatMap heatMapOf(const sweep_guard::ObjectTouches& touches, ColorBy by, size_t count) {
  HeatMap map;
  if (by == ColorBy::kNothing) return map;
  const size_t listed = std::min({touches.triangles.size(), touches.sweeps.size(), touches.depths.size()});
  for (size_t i = 0; i < listed; ++i) map.largest = std::fmax(map.largest, valueOf(touches, i, by));
  for (size_t i = 0; i < listed; ++i) {
    const double share = shareOf(valueOf(touches, i, by), map.largest, by);
    if (touches.triangles[i] >= count || !(share >= 0.0)) continue;
    const auto color = static_cast<size_t>(share * kHeatColors);
    map.triangles[std::min(color, kHeatColors - 1)].push_back(touches.triangles[i]);
  }
  return map;
}

std::string legendOf(const HeatMap& map, ColorBy by) {
  char text[64];
  if (map == HeatMap()) return "";
  if (by == ColorBy::kTouches) {
    std::snprintf(text, sizeof text, "1 (pale) to %.0f sweeps (dark)", map.largest);
  } else {
    std::snprintf(text, sizeof text, "0 (pale) to %.1f mm (dark)", 1e3 * map.largest);
  }
  return text;
}

}  // namespace sweep_guard_rviz
