#pragma once

#include <OgreColourValue.h>
#include <sweep_guard/ObjectTouches.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sweep_guard_rviz {

/// What a workpiece is colored by.
enum class ColorBy { kNothing, kTouches, kDepth };

constexpr size_t kHeatColors = 6;

/// Returns the colors of a heat map, from little to much: none is the color of a level.
const std::array<Ogre::ColourValue, kHeatColors>& heatColors();

/// The touched triangles by their color: ascending, each once.
struct HeatMap {
  std::array<std::vector<std::uint32_t>, kHeatColors> triangles;
  double largest = 0.0;  ///< value of the last color: [sweeps] or [m]; 0: nothing is colored

  bool operator==(const HeatMap& other) const { return triangles == other.triangles && largest == other.largest; }
};

/// Colors each touched triangle by its share of the largest value: of sweeps by the logarithm, of the depth linearly. A
/// triangle whose depth is not known has no color. Drops indices that the workpiece does not have.
/// @param count  of triangles of the workpiece
HeatMap heatMapOf(const sweep_guard::ObjectTouches& touches, ColorBy by, size_t count);

/// Returns what the colors of a heat map mean, for a status line; empty: nothing is colored.
std::string legendOf(const HeatMap& map, ColorBy by);

}  // namespace sweep_guard_rviz
